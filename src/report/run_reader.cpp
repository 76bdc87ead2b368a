#include "hovercraft_sim/report/run_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>
#include <stdexcept>

#include "hovercraft_sim/bags/recorded_messages.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/report/run_parts.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft_ros {

using hovercraft::Vector3;

namespace {

constexpr std::size_t kMostManoeuvres = 500;  // that a page holds

/// Makes a run of topics, part by part.
class RunMaker {
 public:
  explicit RunMaker(const RecordedTopics& recorded) : recorded_(recorded) {
    run_.source = recorded.path;
    run_.notes = recorded.notes;
  }

  RunData make() {
    readScenario();
    const auto bodies = bodiesIn(recorded_, run_.scenario ? &*run_.scenario : nullptr);
    if (bodies.empty()) {
      throw std::invalid_argument(fmt::format(
          "{}: nothing in it tells where something was: must have a topic of poses or of odometry, "
          "such as geometry_msgs/PoseStamped, nav_msgs/Odometry or hovercraft_sim/State",
          recorded_.path));
    }
    findZero(bodies);
    readContacts();
    for (const BodyTopics& topics : bodies) addBody(topics);
    if (run_.bodies.empty()) {
      throw std::invalid_argument(
          fmt::format("{}: none of its poses has finite numbers", recorded_.path));
    }
    if (run_.scenario) {
      run_.obstacles = obstaclesOf(*run_.scenario);
      run_.ground = groundOf(*run_.scenario);
    }
    readMarks();
    readManoeuvres();
    addOtherPanels();
    addFacts(bodies);
    return std::move(run_);
  }

 private:
  void readScenario();
  void findZero(const std::vector<BodyTopics>& bodies);
  void readContacts();
  void addBody(const BodyTopics& topics);
  /// What the scenario says of a body: shapes, engines, and the work of its forces.
  void describe(const hovercraft::VehicleScenario& described, const BodyTopics& topics,
                RunBody& body);
  std::vector<std::int64_t> contactsOf(const std::string& body) const;
  const hovercraft::VehicleScenario* describedBody(const std::string& name, bool& is_craft) const;
  void readMarks();
  void readManoeuvres();
  void addOtherPanels();
  void addFacts(const std::vector<BodyTopics>& bodies);
  void addBodyFacts();
  void addHashFacts(const std::vector<BodyTopics>& bodies);
  void addTelemetryFacts();
  void fact(const std::string& label, const std::string& value) {
    run_.facts.push_back({label, value});
  }
  const TopicSamples* ofType(const char* type) const;

  const RecordedTopics& recorded_;
  RunData run_;
  std::set<std::string> used_;  // topics that have their place
};

const TopicSamples* RunMaker::ofType(const char* type) const {
  for (const auto& [topic, samples] : recorded_.topics) {
    if (samples.type == type && samples.size() > 0) return &samples;
  }
  return nullptr;
}

void RunMaker::readScenario() {
  for (const auto& [topic, samples] : recorded_.topics) {
    const auto* texts = samples.textColumn("data");
    if (samples.type != "std_msgs/String" || !endsWith(topic, "/scenario")) continue;
    if (texts == nullptr || texts->empty()) continue;
    used_.insert(topic);
    run_.scenario_text = texts->front();
    try {
      hovercraft::ScenarioSource source;
      source.name = recorded_.path + ": " + topic;
      source.may_be_older = true;
      run_.scenario = hovercraft::parseScenario(run_.scenario_text, source);
    } catch (const std::exception& error) {
      run_.notes.push_back(fmt::format(
          "Its scenario cannot be read, so that shapes and work are not known: {}.", error.what()));
    }
    return;
  }
  run_.notes.emplace_back(
      "There is no scenario in it, so that shapes, obstacles and work are not known.");
}

/// The first stamp of what tells where the bodies are.
std::int64_t firstStampOf(const std::vector<BodyTopics>& bodies) {
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  for (const BodyTopics& body : bodies) {
    for (const TopicSamples* samples : {body.state, body.odom, body.pose}) {
      if (samples != nullptr && samples->size() > 0) {
        first_ns = std::min(first_ns, samples->stamps_ns.front());
      }
    }
  }
  return first_ns;
}

void RunMaker::findZero(const std::vector<BodyTopics>& bodies) {
  const std::int64_t first_ns = firstStampOf(bodies);
  run_.zero_ns = first_ns;
  if (!run_.scenario) return;
  for (const BodyTopics& body : bodies) {
    const auto* ticks = body.state != nullptr ? body.state->column("tick") : nullptr;
    if (ticks == nullptr || ticks->size() < 2) continue;
    // Of the last one, as ROS stamps tick 0 like tick 1.
    const double episode_ns = ticks->back() * static_cast<double>(run_.scenario->step_ns);
    if (!(episode_ns >= 0.0 && episode_ns < 4e18)) return;
    const auto zero_ns = body.state->stamps_ns.back() - static_cast<std::int64_t>(episode_ns);
    const auto* episodes = body.state->column("episode");
    const bool has_reset = episodes != nullptr && episodes->front() != episodes->back();
    if (!has_reset && zero_ns <= first_ns) run_.zero_ns = zero_ns;
    return;
  }
}

const char* kindOfContact(double kind) {
  static const std::array<const char*, 3> words = {"bounce", "stick", "rest"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (kind == static_cast<double>(i)) return words[i];
  }
  return "contact";
}

/// A vector of a message; what it lacks is 0.
Vector3 vectorOf(const TopicSamples& samples, const std::string& name, std::size_t i) {
  Vector3 value = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    const auto* column = samples.column(name + "." + "xyz"[k]);
    if (column != nullptr) value[k] = (*column)[i];
  }
  return value;
}

void RunMaker::readContacts() {
  for (const auto& [topic, samples] : recorded_.topics) {
    if (samples.type != "hovercraft_sim/Contact") continue;
    used_.insert(topic);
    const auto* kinds = samples.column("kind");
    const auto* a = samples.textColumn("body_a");
    const auto* b = samples.textColumn("body_b");
    if (kinds == nullptr || a == nullptr || b == nullptr) continue;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      RunContact contact;
      contact.time_ns = samples.stamps_ns[i] - run_.zero_ns;
      contact.kind = kindOfContact((*kinds)[i]);
      contact.a = (*a)[i];
      contact.b = (*b)[i];
      contact.point = vectorOf(samples, "point", i);
      contact.normal = vectorOf(samples, "normal", i);
      contact.impulse = vectorOf(samples, "impulse", i);
      run_.contacts.push_back(contact);
    }
  }
}

const hovercraft::VehicleScenario* RunMaker::describedBody(const std::string& name,
                                                           bool& is_craft) const {
  is_craft = true;
  if (!run_.scenario) return nullptr;
  for (const auto& craft : run_.scenario->vehicles) {
    if (craft.name == name) return &craft;
  }
  is_craft = false;
  if (!run_.scenario->world) return nullptr;
  for (const auto& body : run_.scenario->world->bodies) {
    if (body.name == name) return &body;
  }
  return nullptr;
}

std::vector<std::int64_t> RunMaker::contactsOf(const std::string& body) const {
  std::vector<std::int64_t> contacts_ns;
  for (const RunContact& contact : run_.contacts) {
    if (contact.a == body || contact.b == body) contacts_ns.push_back(contact.time_ns);
  }
  return contacts_ns;
}

void RunMaker::describe(const hovercraft::VehicleScenario& described, const BodyTopics& topics,
                        RunBody& body) {
  try {
    body.shapes = shapesOf(described, body.is_craft);
  } catch (const std::exception& error) {
    run_.notes.push_back(fmt::format("{} is drawn without its hull: {}.", body.name, error.what()));
  }
  body.engines = enginesOf(described);
  if (topics.state == nullptr) return;
  body.ledger =
      ledgerOf(topics, described, run_.scenario->wind, run_.zero_ns, contactsOf(body.name));
}

void RunMaker::addBody(const BodyTopics& topics) {
  RunBody body;
  body.name = topics.name;
  const hovercraft::VehicleScenario* described = describedBody(topics.name, body.is_craft);
  if (described == nullptr) body.is_craft = true;
  const Vector3 p_HB =
      described != nullptr ? described->mass_properties.p_HB : Vector3(Vector3::Zero());
  for (const auto* samples :
       {topics.state, topics.odom, topics.pose, topics.twist, topics.engines}) {
    if (samples != nullptr) used_.insert(samples->topic);
  }
  body.motion = motionOf(topics, p_HB, run_.zero_ns);
  if (body.motion.times_ns.empty()) return;
  run_.end_ns = std::max(run_.end_ns, body.motion.times_ns.back());
  body.velocity = velocityOf(topics, body.motion, p_HB, run_.zero_ns);
  if (described != nullptr) describe(*described, topics, body);
  body.panels = mainPanels(body, topics, run_.zero_ns);
  run_.bodies.push_back(std::move(body));
}

void RunMaker::readMarks() {
  const TopicSamples* events = ofType("hovercraft_sim/RunEvent");
  if (events == nullptr) return;
  used_.insert(events->topic);
  const auto* kinds = events->column("kind");
  const auto* vehicles = events->textColumn("vehicle");
  if (kinds == nullptr) return;
  for (std::size_t i = 0; i < events->size(); ++i) {
    static const std::array<const char*, 5> words = {"event", "reset", "load", "set_state",
                                                     "apply_wrench"};
    const double kind = (*kinds)[i];
    std::string text = words[kind >= 1.0 && kind < 5.0 ? static_cast<std::size_t>(kind) : 0];
    if (vehicles != nullptr && !(*vehicles)[i].empty()) text += " " + (*vehicles)[i];
    run_.marks.push_back({events->stamps_ns[i] - run_.zero_ns, text});
  }
}

void RunMaker::readManoeuvres() {
  for (const auto& [topic, samples] : recorded_.topics) {
    if (samples.type != "hovercraft_sim/Manoeuvre") continue;
    used_.insert(topic);
    for (RunManoeuvre& manoeuvre : manoeuvresOf(topic, samples, run_.zero_ns)) {
      if (run_.manoeuvres.size() == kMostManoeuvres) {
        run_.notes.push_back(fmt::format("Of {} only the first manoeuvres are shown.", topic));
        break;
      }
      run_.manoeuvres.push_back(std::move(manoeuvre));
    }
  }
  std::stable_sort(run_.manoeuvres.begin(), run_.manoeuvres.end(),
                   [](const auto& a, const auto& b) { return a.execute_ns < b.execute_ns; });
}

void RunMaker::addOtherPanels() {
  for (const auto& [topic, samples] : recorded_.topics) {
    if (used_.count(topic) > 0 || samples.type == "hovercraft_sim/AppliedCommand") continue;
    const std::string& name = topic;
    const auto owner = std::find_if(
        run_.bodies.begin(), run_.bodies.end(),
        [&](const RunBody& body) { return name.rfind("/" + body.name + "/", 0) == 0; });
    auto& panels = owner == run_.bodies.end() ? run_.panels : owner->panels;
    for (RunPanel& panel : panelsOfTopic(samples, run_.zero_ns)) {
      panels.push_back(std::move(panel));
    }
  }
}

double lengthOf(const RunMotion& motion) {
  double length = 0.0;
  for (std::size_t i = 1; i < motion.times_ns.size(); ++i) {
    Vector3 step = Vector3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      step[static_cast<Eigen::Index>(k)] = motion.position[k][i] - motion.position[k][i - 1];
    }
    length += hovercraft::norm(step);
  }
  return length;
}

double topSpeedOf(const RunVelocity& velocity) {
  double top = 0.0;
  for (std::size_t i = 0; i < velocity.times_ns.size(); ++i) {
    const double speed =
        std::hypot(velocity.linear[0][i], velocity.linear[1][i], velocity.linear[2][i]);
    if (std::isfinite(speed)) top = std::max(top, speed);
  }
  return top;
}

void RunMaker::addBodyFacts() {
  for (const RunBody& body : run_.bodies) {
    if (!body.is_craft) continue;
    const std::string whose = run_.bodies.size() > 1 ? body.name + ": " : "";
    fact(whose + "distance", fmt::format("{:.2f} m", lengthOf(body.motion)));
    if (body.velocity) {
      fact(whose + "top speed", fmt::format("{:.2f} m/s", topSpeedOf(*body.velocity)));
    }
  }
}

void RunMaker::addHashFacts(const std::vector<BodyTopics>& bodies) {
  for (const BodyTopics& body : bodies) {
    if (body.state == nullptr) continue;
    for (std::size_t i = 0; i < body.state->leaves.size(); ++i) {
      if (body.state->leaves[i].path != "hash" || body.state->size() == 0) continue;
      fact(body.name + ": hash of the last state",
           fmt::format("{:016x}", static_cast<std::uint64_t>(body.state->last_integers[i])));
    }
  }
}

void RunMaker::addFacts(const std::vector<BodyTopics>& bodies) {
  fact("simulated", fmt::format("{:.2f} s", 1e-9 * static_cast<double>(run_.end_ns)));
  addBodyFacts();
  if (!run_.contacts.empty()) fact("contacts", std::to_string(run_.contacts.size()));
  addHashFacts(bodies);
  if (run_.scenario) {
    fact("step size", hovercraft::numberText(run_.scenario->stepSize()) + " s");
    fact("seed", std::to_string(run_.scenario->seed));
  }
  addTelemetryFacts();
}

void RunMaker::addTelemetryFacts() {
  const TopicSamples* telemetry = ofType("hovercraft_sim/Telemetry");
  if (telemetry == nullptr) return;
  const auto sum = [&](const char* name) {
    const auto* column = telemetry->column(name);
    double total = 0.0;
    if (column != nullptr) {
      for (const double value : *column) total += value;
    }
    return total;
  };
  const auto most = [&](const char* name) {
    const auto* column = telemetry->column(name);
    if (column == nullptr) return 0.0;
    return *std::max_element(column->begin(), column->end());
  };
  const auto count = static_cast<double>(telemetry->size());
  fact("real-time factor, mean", fmt::format("{:.3f}", sum("real_time_factor") / count));
  fact("late steps", fmt::format("{:.0f}", sum("late_steps")));
  fact("lateness p99, greatest", fmt::format("{:.2f} ms", 1e3 * most("lateness_p99")));
  fact("step time p99, greatest", fmt::format("{:.1f} µs", 1e6 * most("step_time_p99")));
}

}  // namespace

RunData runDataOf(const RecordedTopics& recorded) {
  return RunMaker(recorded).make();
}

}  // namespace hovercraft_ros
