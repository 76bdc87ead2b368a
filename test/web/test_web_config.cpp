#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/yaml_text.h"
#include "hovercraft_sim/web/web_config.h"

namespace hovercraft_ros {
namespace {

WebConfig parsed(const std::string& yaml) {
  return parseWebConfig(hovercraft::treeOf(yaml, "test"), "/web");
}

std::string refusal(const std::string& yaml) {
  try {
    parsed(yaml);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(WebConfig, DefaultsServeThisMachineAlone) {
  const WebConfig config = parsed("{}");
  EXPECT_EQ(config.address, "127.0.0.1");
  EXPECT_EQ(config.port, 8080);
  EXPECT_EQ(config.access.token, "");
  EXPECT_EQ(urlOf(config, 8080), "http://127.0.0.1:8080/");
}

TEST(WebConfig, AnyOtherAddressNeedsAToken) {
  for (const char* address : {"0.0.0.0", "192.168.1.2", "'::'", "'fe80::1'", "128.0.0.1"}) {
    const std::string yaml = std::string("{address: ") + address;
    EXPECT_NE(refusal(yaml + "}").find("give a token"), std::string::npos) << address;
    EXPECT_EQ(refusal(yaml + ", token: 0123456789abcdeF}"), "") << address;
  }
  for (const char* address : {"127.0.0.1", "127.9.9.9", "'::1'"}) {
    EXPECT_EQ(refusal(std::string("{address: ") + address + "}"), "") << address;
  }
}

TEST(WebConfig, WhatIsWrongIsNamedAndATokenIsNotSaid) {
  EXPECT_NE(refusal("{address: localhost}").find("/web: address = localhost: must be an address"),
            std::string::npos);
  EXPECT_NE(refusal("{port: 65536}").find("port = 65536: must be 0 to 65535"), std::string::npos);
  EXPECT_NE(refusal("{port: -1}").find("must be 0 to 65535"), std::string::npos);
  EXPECT_NE(refusal("{rate: 0.5}").find("must be 1 to 60 Hz"), std::string::npos);
  EXPECT_NE(refusal("{viewers: 0}").find("must be 1 to 64"), std::string::npos);
  EXPECT_NE(refusal("{colour: red}").find("colour"), std::string::npos);
  EXPECT_NE(refusal("{hosts: 'a.example:80'}").find("without ports"), std::string::npos);
  const std::string token = refusal("{token: secret}");
  EXPECT_NE(token.find("16 to 128"), std::string::npos);
  EXPECT_EQ(token.find("secret"), std::string::npos);
}

TEST(WebConfig, HostsAreNamesWithCommasBetween) {
  const WebConfig config = parsed("{hosts: ' Robot.example,, b ,'}");
  EXPECT_EQ(config.access.hosts, (std::vector<std::string>{"robot.example", "b"}));
  EXPECT_TRUE(parsed("{hosts: ','}").access.hosts.empty());
}

TEST(WebConfig, AnAddressOfIpv6StandsInBracketsAndTheTokenIsNotShown) {
  EXPECT_EQ(urlOf(parsed("{address: '::1', token: 0123456789abcdeF}"), 80),
            "http://[::1]:80/#token=TOKEN");
}

}  // namespace
}  // namespace hovercraft_ros
