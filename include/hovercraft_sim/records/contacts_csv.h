#pragma once

#include <string>

#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/sim/run_observer.h"

namespace hovercraft {

/// The words for contact kinds, in the order of ContactKind.
extern HOVERCRAFT_PUBLIC const char* const kContactKindNames[3];

/// Writes the contacts as CSV with the header
/// `time,kind,a,b,x,y,z,nx,ny,nz,jx,jy,jz`: s, bounce | stick | rest, names, point (m), normal from
/// a to b, impulse on b (N s), all in W. Numbers as appendNumber().
class HOVERCRAFT_PUBLIC ContactsCsvWriter : public RunObserver {
 public:
  /// @throws std::invalid_argument if the file cannot be opened for writing.
  explicit ContactsCsvWriter(const std::string& path);

  void contact(const ContactEvent& event) override;
  void close() override;

 private:
  OutputFile file_;
};

}  // namespace hovercraft
