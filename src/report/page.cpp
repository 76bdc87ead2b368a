#include "hovercraft_sim/report/page.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/io/base64.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/report/front_end.h"
#include "hovercraft_sim/report/json_text.h"
#include "hovercraft_sim/report/packed_numbers.h"

namespace hovercraft_ros {

using hovercraft::Vector3;

namespace {

/// More samples of one topic than 11 minutes at 100 Hz are thinned.
constexpr std::size_t kMostSamples = 65536;

std::size_t strideOf(std::size_t count) {
  return std::max<std::size_t>(1, (count + kMostSamples - 1) / kMostSamples);
}

double toSeconds(std::int64_t time_ns) {
  return 1e-9 * static_cast<double>(time_ns);
}

/// Writes runs as JSON, their numbers into one block of bytes.
class PageWriter {
 public:
  std::string write(const std::vector<RunData>& runs,
                    const std::vector<BodyComparison>& comparisons) {
    json_.beginObject();
    json_.key("format").value(1);
    json_.key("runs").beginList();
    for (const RunData& run : runs) writeRun(run);
    json_.endList();
    json_.key("comparison").beginList();
    for (const BodyComparison& comparison : comparisons) writeComparison(comparison);
    json_.endList();
    json_.key("stride").value(greatest_stride_);
    json_.key("numbers").value(
        hovercraft::base64Text({numbers_.bytes().begin(), numbers_.bytes().end()}));
    json_.endObject();
    return json_.text();
  }

 private:
  void writeColumn(const PackedColumn& column) {
    json_.beginList().value(column.begin).value(column.count).value(column.least);
    json_.value(column.step).endList();
  }
  void writeTimes(const std::vector<std::int64_t>& times_ns) {
    const std::size_t stride = strideOf(times_ns.size());
    greatest_stride_ = std::max(greatest_stride_, stride);
    writeColumn(numbers_.addTimes(times_ns, stride));
  }
  void writeCurve(const std::vector<double>& values, int bits = PackedNumbers::kCurveBits) {
    writeColumn(numbers_.add(values, bits, strideOf(values.size())));
  }
  void writeVector(const Vector3& vector) {
    json_.beginList().value(vector.x()).value(vector.y()).value(vector.z()).endList();
  }

  void writeRun(const RunData& run);
  void writeBody(const RunBody& body);
  void writeMotion(const RunMotion& motion);
  void writeShapes(const std::vector<RunShape>& shapes);
  void writeFaces(const RunShape& shape);
  void writePanels(const std::vector<RunPanel>& panels);
  void writeBands(const std::vector<RunBand>& bands);
  void writeContacts(const std::vector<RunContact>& contacts);
  void writeManoeuvres(const std::vector<RunManoeuvre>& manoeuvres);
  void writeWords(const RunData& run);
  void writeLedger(const EnergyLedger& ledger);
  void writeGround(const RunGround& ground);
  void writeComparison(const BodyComparison& comparison);

  JsonWriter json_;
  PackedNumbers numbers_;
  std::size_t greatest_stride_ = 1;
};

void PageWriter::writeRun(const RunData& run) {
  json_.beginObject();
  json_.key("source").value(run.source);
  json_.key("end").value(toSeconds(run.end_ns));
  json_.key("bodies").beginList();
  for (const RunBody& body : run.bodies) writeBody(body);
  json_.endList();
  json_.key("obstacles").beginList();
  for (const RunObstacle& obstacle : run.obstacles) {
    json_.beginObject().key("name").value(obstacle.name);
    writeShapes(obstacle.shapes);
    json_.endObject();
  }
  json_.endList();
  if (run.ground) writeGround(*run.ground);
  writeContacts(run.contacts);
  writeManoeuvres(run.manoeuvres);
  writePanels(run.panels);
  writeWords(run);
  json_.endObject();
}

void PageWriter::writeWords(const RunData& run) {
  json_.key("marks").beginList();
  for (const RunMark& mark : run.marks) {
    json_.beginObject().key("time").value(toSeconds(mark.time_ns));
    json_.key("text").value(mark.text).endObject();
  }
  json_.endList();
  json_.key("facts").beginList();
  for (const RunFact& fact : run.facts) {
    json_.beginList().value(fact.label).value(fact.value).endList();
  }
  json_.endList();
  json_.key("notes").beginList();
  for (const std::string& note : run.notes) json_.value(note);
  json_.endList();
  json_.key("scenario").value(run.scenario_text);
}

void PageWriter::writeBody(const RunBody& body) {
  json_.beginObject();
  json_.key("name").value(body.name);
  json_.key("craft").value(body.is_craft);
  writeShapes(body.shapes);
  json_.key("engines").beginList();
  for (const RunEngine& engine : body.engines) {
    json_.beginObject().key("name").value(engine.name);
    json_.key("position");
    writeVector(engine.position);
    json_.key("direction");
    writeVector(engine.direction);
    json_.key("full").value(engine.full_thrust).endObject();
  }
  json_.endList();
  writeMotion(body.motion);
  writePanels(body.panels);
  if (body.ledger) writeLedger(*body.ledger);
  json_.endObject();
}

void PageWriter::writeMotion(const RunMotion& motion) {
  json_.key("motion").beginObject();
  json_.key("source").value(motion.source);
  json_.key("t");
  writeTimes(motion.times_ns);
  json_.key("p").beginList();
  for (const auto& column : motion.position) writeCurve(column, PackedNumbers::kPositionBits);
  json_.endList().key("q").beginList();
  for (const auto& column : motion.orientation) writeCurve(column);
  json_.endList().endObject();
}

void PageWriter::writeShapes(const std::vector<RunShape>& shapes) {
  static const std::array<const char*, 5> kinds = {"box", "cylinder", "cone", "sphere", "faces"};
  json_.key("shapes").beginList();
  for (const RunShape& shape : shapes) {
    json_.beginObject();
    json_.key("kind").value(kinds[static_cast<std::size_t>(shape.kind)]);
    json_.key("role").value(shape.role);
    json_.key("size");
    writeVector(shape.size);
    json_.key("position");
    writeVector(shape.position);
    json_.key("orientation").beginList().value(shape.orientation.v.x());
    json_.value(shape.orientation.v.y()).value(shape.orientation.v.z());
    json_.value(shape.orientation.s).endList();
    if (shape.kind == RunShape::Kind::kFaces) writeFaces(shape);
    json_.endObject();
  }
  json_.endList();
}

void PageWriter::writeFaces(const RunShape& shape) {
  json_.key("vertices").beginList();
  for (const Vector3& vertex : shape.vertices) writeVector(vertex);
  json_.endList().key("faces").beginList();
  for (const auto& face : shape.faces) {
    json_.beginList();
    for (const std::int32_t vertex : face) json_.value(int{vertex});
    json_.endList();
  }
  json_.endList();
}

void PageWriter::writePanels(const std::vector<RunPanel>& panels) {
  json_.key("panels").beginList();
  for (const RunPanel& panel : panels) {
    json_.beginObject();
    json_.key("title").value(panel.title);
    json_.key("source").value(panel.source);
    json_.key("unit").value(panel.unit);
    json_.key("main").value(panel.is_main);
    json_.key("t");
    writeTimes(panel.times_ns);
    json_.key("curves").beginList();
    for (const RunCurve& curve : panel.curves) {
      json_.beginObject().key("label").value(curve.label);
      json_.key("demand").value(curve.is_demand);
      json_.key("y");
      writeCurve(curve.values);
      json_.endObject();
    }
    json_.endList();
    writeBands(panel.bands);
    json_.endObject();
  }
  json_.endList();
}

void PageWriter::writeBands(const std::vector<RunBand>& bands) {
  json_.key("bands").beginList();
  for (const RunBand& band : bands) {
    json_.beginObject();
    json_.key("label").value(band.label);
    json_.key("kind").value(band.kind);
    json_.key("spans").beginList();
    for (const auto& [begin_ns, end_ns] : band.spans_ns) {
      json_.beginList().value(toSeconds(begin_ns)).value(toSeconds(end_ns)).endList();
    }
    json_.endList().endObject();
  }
  json_.endList();
}

void PageWriter::writeContacts(const std::vector<RunContact>& contacts) {
  json_.key("contacts").beginList();
  for (const RunContact& contact : contacts) {
    json_.beginObject();
    json_.key("time").value(toSeconds(contact.time_ns));
    json_.key("kind").value(contact.kind);
    json_.key("a").value(contact.a);
    json_.key("b").value(contact.b);
    json_.key("point");
    writeVector(contact.point);
    json_.key("normal");
    writeVector(contact.normal);
    json_.key("impulse");
    writeVector(contact.impulse);
    json_.endObject();
  }
  json_.endList();
}

void PageWriter::writeManoeuvres(const std::vector<RunManoeuvre>& manoeuvres) {
  json_.key("manoeuvres").beginList();
  for (const RunManoeuvre& manoeuvre : manoeuvres) {
    json_.beginObject();
    json_.key("craft").value(manoeuvre.craft);
    json_.key("name").value(manoeuvre.name);
    json_.key("kind").value(manoeuvre.kind);
    json_.key("complete").value(manoeuvre.is_complete);
    json_.key("time").value(toSeconds(manoeuvre.execute_ns));
    json_.key("end").value(toSeconds(manoeuvre.end_ns));
    json_.key("text").value(manoeuvre.text).endObject();
  }
  json_.endList();
}

void PageWriter::writeLedger(const EnergyLedger& ledger) {
  json_.key("ledger").beginObject();
  json_.key("begin").value(ledger.begin);
  json_.key("engines").value(ledger.engines);
  json_.key("drag").value(ledger.drag);
  json_.key("contacts").value(ledger.contacts);
  json_.key("others").value(ledger.others);
  json_.key("end").value(ledger.end).endObject();
}

void PageWriter::writeGround(const RunGround& ground) {
  json_.key("ground").beginObject();
  json_.key("height").value(ground.height);
  json_.key("normal");
  writeVector(ground.normal);
  json_.key("columns").value(ground.columns);
  json_.key("spacing").value(ground.spacing);
  json_.key("x").value(ground.x);
  json_.key("y").value(ground.y);
  json_.key("heights");
  writeCurve(ground.heights);
  json_.endObject();
}

void PageWriter::writeComparison(const BodyComparison& body) {
  const hovercraft::Comparison& comparison = body.comparison;
  std::vector<std::int64_t> times_ns;
  std::vector<double> position;
  std::vector<double> attitude;
  for (const hovercraft::TrajectoryError& error : comparison.errors) {
    times_ns.push_back(error.time_ns);
    position.push_back(error.position);
    attitude.push_back(error.attitude);
  }
  json_.beginObject();
  json_.key("name").value(body.name);
  json_.key("t");
  writeTimes(times_ns);
  json_.key("position");
  writeCurve(position);
  json_.key("attitude");
  writeCurve(attitude);
  json_.key("greatest").value(comparison.position.max);
  json_.key("greatestTime").value(toSeconds(comparison.position.max_time_ns));
  json_.key("rms").value(comparison.position.rms);
  json_.key("greatestAttitude").value(comparison.attitude.max);
  if (comparison.divergence) {
    const hovercraft::Divergence& divergence = *comparison.divergence;
    json_.key("parted").beginObject();
    json_.key("time").value(toSeconds(divergence.time_ns));
    json_.key("quantity").value(divergence.quantity);
    json_.key("a").value(hovercraft::numberText(divergence.a));
    json_.key("b").value(hovercraft::numberText(divergence.b)).endObject();
  }
  json_.endObject();
}

/// The poses of a body as a trajectory to compare.
hovercraft::Trajectory trajectoryOf(const RunBody& body, const std::string& source) {
  hovercraft::Trajectory trajectory;
  trajectory.vehicle = body.name;
  trajectory.source = source;
  trajectory.has_velocities = false;
  trajectory.holds_time_zero = false;
  const RunMotion& motion = body.motion;
  for (std::size_t i = 0; i < motion.times_ns.size(); ++i) {
    hovercraft::TrajectorySample sample;
    sample.time_ns = motion.times_ns[i];
    sample.p_WB = {motion.position[0][i], motion.position[1][i], motion.position[2][i]};
    sample.q_WB = {motion.orientation[3][i],
                   {motion.orientation[0][i], motion.orientation[1][i], motion.orientation[2][i]}};
    trajectory.samples.push_back(sample);
  }
  return trajectory;
}

/// Puts `text` in the place of a comment.
void replace(std::string& page, const std::string& comment, std::string_view text) {
  const std::size_t at = page.find(comment);
  if (at == std::string::npos) throw std::logic_error("the front end lacks " + comment);
  page.replace(at, comment.size(), text);
}

}  // namespace

std::vector<BodyComparison> compareRuns(const RunData& a, const RunData& b) {
  std::vector<BodyComparison> comparisons;
  for (const RunBody& body : a.bodies) {
    const auto other = std::find_if(b.bodies.begin(), b.bodies.end(), [&](const RunBody& each) {
      return each.name == body.name || (a.bodies.size() == 1 && b.bodies.size() == 1);
    });
    if (other == b.bodies.end()) continue;
    const auto first = trajectoryOf(body, a.source);
    const auto second = trajectoryOf(*other, b.source);
    hovercraft::CompareOptions options;
    options.matching = hovercraft::SampleMatching::kCommon;
    BodyComparison compared = {body.name, compareTrajectories(first, second, options)};
    if (compared.comparison.errors.empty()) {
      options.matching = hovercraft::SampleMatching::kInterpolated;
      compared.comparison = compareTrajectories(first, second, options);
    }
    comparisons.push_back(std::move(compared));
  }
  return comparisons;
}

std::string pageJson(const std::vector<RunData>& runs,
                     const std::vector<BodyComparison>& comparisons) {
  return PageWriter().write(runs, comparisons);
}

std::string pageOf(const std::vector<RunData>& runs,
                   const std::vector<BodyComparison>& comparisons) {
  std::string page(frontEndPage());
  // The script first: the data may hold what looks like a comment.
  replace(page, "<!-- script -->", frontEndScript());
  replace(page, "<!-- data -->", pageJson(runs, comparisons));
  return page;
}

}  // namespace hovercraft_ros
