#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hovercraft::fuzz {

/// One reader of foreign bytes. It returns for whatever it is given: std::invalid_argument, and the
/// std::runtime_error of a motion that diverges, are answers; any other exception, a crash and a
/// sanitizer's report are findings.
struct Target {
  const char* name;  // of its folders of seeds and of findings
  void (*run)(const std::string& input);
};

void readScenario(const std::string& input);
/// Parses a scenario and flies it for some ticks, with commands.
void flyScenario(const std::string& input);
void readCommandsCsv(const std::string& input);
void readStatesCsv(const std::string& input);
/// A snapshot without its scenario, which is added, and with whatever hash, which is set right.
void readSnapshot(const std::string& input);
/// A file of manoeuvres, which is then flown for a while.
void flyPilot(const std::string& input);
void readBag(const std::string& input);
/// A bag as `report` makes a page of it.
void reportBag(const std::string& input);
/// The type of a message, a line end, its definition, a byte of 0, and a message.
void readLayout(const std::string& input);
/// An image of heights, PGM or PNG.
void readImage(const std::string& input);
/// As OBJ and as STL, as a surface and as a body.
void readMesh(const std::string& input);
/// A message of a viewer, and the head of its request.
void hearViewer(const std::string& input);

inline const std::vector<Target>& targets() {
  static const std::vector<Target> all = {{"scenario", readScenario},
                                          {"fly_scenario", flyScenario},
                                          {"commands_csv", readCommandsCsv},
                                          {"states_csv", readStatesCsv},
                                          {"snapshot", readSnapshot},
                                          {"pilot", flyPilot},
                                          {"bag", readBag},
                                          {"report_bag", reportBag},
                                          {"layout", readLayout},
                                          {"image", readImage},
                                          {"mesh", readMesh},
                                          {"viewer", hearViewer}};
  return all;
}

}  // namespace hovercraft::fuzz
