#include <functional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/clients/play_config.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft_ros {
namespace {

PlayConfig playConfigOf(const std::string& yaml) {
  return parsePlayConfig(hovercraft::treeOf(yaml, "parameters"), "/play");
}

std::string errorOf(const std::string& yaml) {
  try {
    playConfigOf(yaml);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(PlayConfig, HasItsDefaults) {
  const PlayConfig config = playConfigOf("file: a b.csv");
  EXPECT_EQ(config.file, "a b.csv");
  EXPECT_EQ(config.settle_ns, 1000000000);
  EXPECT_EQ(config.wanted_subscribers, 1U);
  EXPECT_FALSE(config.ends_launch);
}

TEST(PlayConfig, TakesWhatIsSet) {
  const PlayConfig config =
      playConfigOf("{file: c.csv, settle: 2.5, wanted_subscribers: 3, ends_launch: true}");
  EXPECT_EQ(config.settle_ns, 2500000000);
  EXPECT_EQ(config.wanted_subscribers, 3U);
  EXPECT_TRUE(config.ends_launch);
}

TEST(PlayConfig, NothingIsClampedCutOffOrLeftOut) {
  EXPECT_EQ(errorOf("{}"), "/play/file: the parameter is missing: a commands CSV");
  for (const char* settle : {"-1", "-.inf", ".inf", ".nan", "1e7", "soon"}) {
    const std::string error = errorOf(std::string("{file: c.csv, settle: ") + settle + "}");
    EXPECT_NE(error.find("settle = "), std::string::npos) << error;
  }
  for (const char* wanted : {"0", "-1", "1.5", "4294967297", "all"}) {
    const std::string error =
        errorOf(std::string("{file: c.csv, wanted_subscribers: ") + wanted + "}");
    EXPECT_NE(error.find("wanted_subscribers = "), std::string::npos) << error;
  }
  EXPECT_NE(errorOf("{file: c.csv, ends_launch: perhaps}").find("ends_launch = perhaps"),
            std::string::npos);
  EXPECT_NE(errorOf("{file: c.csv, setle: 1}").find("setle"), std::string::npos);
}

}  // namespace
}  // namespace hovercraft_ros
