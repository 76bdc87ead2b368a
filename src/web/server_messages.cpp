#include "hovercraft_sim/web/server_messages.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/io/utf8.h"
#include "hovercraft_sim/report/json_text.h"
#include "hovercraft_sim/report/page.h"
#include "hovercraft_sim/report/run_parts.h"
#include "hovercraft_sim/web/craft_controls.h"

namespace hovercraft_ros {
namespace {

constexpr int kProtocol = 1;

JsonWriter begin(const char* type) {
  JsonWriter json;
  json.beginObject().key("type").value(type);
  return json;
}

/// Seven digits: more than a picture shows.
void append(std::string& text, double value) {
  if (text.back() != '[') text += ',';
  text += std::isfinite(value) ? fmt::format("{:.7g}", value) : "null";
}

template <class Values>
void append(std::string& text, const Values& values) {
  for (const double value : values) append(text, value);
}

void openList(std::string& text) {
  if (text.back() == ']') text += ',';
  text += '[';
}

void appendPoses(std::string& text, const std::vector<LiveBody>& bodies) {
  for (const LiveBody& body : bodies) {
    openList(text);
    append(text, body.position);
    append(text, body.orientation);
    text += ']';
  }
}

void writeControls(JsonWriter& json, const hovercraft::Scenario& scenario) {
  json.key("controls").beginList();
  for (const hovercraft::VehicleScenario& craft : scenario.vehicles) {
    json.beginList();
    for (const CraftControl& control : controlsOf(craft)) {
      json.beginObject().key("name").value(control.name);
      json.key("unit").value(control.unit);
      json.key("least").value(control.least).key("most").value(control.most);
      json.key("rest").value(control.rest).key("holds").value(control.holds);
      json.key("ahead").value(control.ahead).key("turn").value(control.turn).endObject();
    }
    json.endList();
  }
  json.endList();
}

RunBody bodyOf(const hovercraft::VehicleScenario& description, bool is_craft) {
  RunBody body;
  body.name = description.name;
  body.is_craft = is_craft;
  body.shapes = shapesOf(description, is_craft);
  if (is_craft) body.engines = enginesOf(description);
  return body;
}

/// Each text of a WebSocket must be UTF-8, or the browser hangs up.
std::string readable(std::string text) {
  if (!hovercraft::faultOfText(text)) return text;
  for (char& c : text) {
    if (static_cast<unsigned char>(c) >= 0x80) c = '?';
  }
  return text;
}

}  // namespace

std::string sceneMessage(const hovercraft::Scenario& scenario, const std::string& source,
                         const std::string& text) {
  RunData run;
  run.source = source;
  run.scenario_text = text;
  for (const auto& vehicle : scenario.vehicles) run.bodies.push_back(bodyOf(vehicle, true));
  if (scenario.world) {
    for (const auto& loose : scenario.world->bodies) run.bodies.push_back(bodyOf(loose, false));
  }
  run.obstacles = obstaclesOf(scenario);
  run.ground = groundOf(scenario);
  run.facts.push_back({"step", hovercraft::numberText(1e3 * scenario.stepSize()) + " ms"});
  JsonWriter json = begin("scene");
  writeControls(json, scenario);
  // The page's JSON is an object of its own.
  return json.text() + ",\"report\":" + pageJson({run}, {}) + '}';
}

std::string stateMessage(const LiveState& state) {
  std::string text = fmt::format(R"({{"type":"state","t":{:.12g},"tick":{},"episode":{},"poses":[)",
                                 state.time, state.tick, state.episode);
  appendPoses(text, state.craft);
  appendPoses(text, state.bodies);
  text += R"(],"motions":[)";
  for (const LiveBody& craft : state.craft) {
    openList(text);
    append(text, craft.velocity);
    append(text, craft.angular_velocity);
    text += ']';
  }
  for (const auto& [key, column] :
       {std::pair{"applied", &LiveBody::applied}, std::pair{"demanded", &LiveBody::demanded}}) {
    text += fmt::format(R"(],"{}":[)", key);
    for (const LiveBody& craft : state.craft) {
      openList(text);
      append(text, craft.*column);
      text += ']';
    }
  }
  return text + "]}";
}

std::string paceMessage(const LivePace& pace) {
  JsonWriter json = begin("pace");
  json.key("there").value(pace.is_there).key("paused").value(pace.is_paused);
  json.key("wanted").value(pace.wanted).key("reached").value(pace.reached).endObject();
  return json.text();
}

std::string seatsMessage(const DriverSeats& seats, const std::vector<std::string>& craft,
                         const std::vector<Viewer>& viewers) {
  JsonWriter json = begin("seats");
  json.key("viewers").value(viewers.size()).key("seats").beginList();
  for (std::size_t i = 0; i < seats.size(); ++i) {
    const ViewerId driver = seats.driver(i).value_or(0);
    const auto found = std::find_if(viewers.begin(), viewers.end(),
                                    [&](const Viewer& viewer) { return viewer.id == driver; });
    json.beginObject().key("craft").value(craft[i]);
    json.key("driver").value(static_cast<std::size_t>(driver));
    json.key("name").value(found == viewers.end() ? "" : found->name).endObject();
  }
  json.endList().endObject();
  return json.text();
}

std::string helloMessage(const Viewer& viewer) {
  JsonWriter json = begin("hello");
  json.key("protocol").value(kProtocol).key("you").value(static_cast<std::size_t>(viewer.id));
  json.key("name").value(viewer.name).endObject();
  return json.text();
}

std::string noteMessage(const std::string& text, bool is_failure) {
  JsonWriter json = begin("note");
  json.key("text").value(readable(text)).key("failure").value(is_failure).endObject();
  return json.text();
}

}  // namespace hovercraft_ros
