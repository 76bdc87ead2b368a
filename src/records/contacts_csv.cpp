#include "hovercraft_sim/records/contacts_csv.h"

#include <cstddef>
#include <fmt/format.h>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {
namespace {

std::string columns(const Vector3& v) {
  return fmt::format("{},{},{}", numberText(v.x()), numberText(v.y()), numberText(v.z()));
}

}  // namespace

const char* const kContactKindNames[3] = {"bounce", "stick", "rest"};

ContactsCsvWriter::ContactsCsvWriter(const std::string& path) : file_(path) {
  const std::string header = "time,kind,a,b,x,y,z,nx,ny,nz,jx,jy,jz\n";
  file_.write(header.data(), header.size());
}

void ContactsCsvWriter::contact(const ContactEvent& event) {
  const std::string row =
      fmt::format("{},{},{},{},{},{},{}\n", numberText(event.time),
                  kContactKindNames[static_cast<std::size_t>(event.kind)], event.a, event.b,
                  columns(event.p_WC), columns(event.nhat_AB_W), columns(event.impulse_B_W));
  file_.write(row.data(), row.size());
}

void ContactsCsvWriter::close() {
  file_.close();
}

}  // namespace hovercraft
