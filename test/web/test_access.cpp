#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/web/access.h"

namespace hovercraft_ros {
namespace {

constexpr const char* kToken = "0123456789abcdef-_XY";

RequestHead request(const std::string& target, const std::string& host = "localhost:8080") {
  RequestHead head;
  head.method = "GET";
  head.target = target;
  head.hosts = {host};
  return head;
}

RequestHead socket(const std::string& origin, const std::string& host = "localhost:8080") {
  RequestHead head = request("/socket", host);
  head.is_upgrade = true;
  head.origins = {origin};
  return head;
}

TEST(Access, ThereAreTwoPagesAndASocket) {
  const AccessRules rules;
  EXPECT_EQ(verdictOn(request("/"), rules), Verdict::kPage);
  EXPECT_EQ(verdictOn(request("/?anything=1"), rules), Verdict::kPage);
  EXPECT_EQ(verdictOn(request("/report.js"), rules), Verdict::kScript);
  EXPECT_EQ(verdictOn(socket("http://localhost:8080"), rules), Verdict::kSocket);
}

TEST(Access, NoOtherPathIsAnything) {
  for (const char* path : {"",
                           "*",
                           "//",
                           "/..",
                           "/../etc/passwd",
                           "/%2e%2e/etc/passwd",
                           "/etc/passwd",
                           "/report.js/",
                           "/report.js/../report.js",
                           "/REPORT.JS",
                           "/socket/",
                           "/./",
                           "/index.html",
                           "/report.js%00",
                           "http://localhost:8080/",
                           "/report.html",
                           "/favicon.ico",
                           "report.js",
                           "\\",
                           "/\\report.js"}) {
    EXPECT_EQ(verdictOn(request(path), {}), Verdict::kNotFound) << path;
  }
}

TEST(Access, OnlyGetIsAnswered) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "CONNECT", "TRACE", "get", ""}) {
    for (const char* path : {"/", "/report.js", "/socket"}) {
      RequestHead head = request(path);
      head.method = method;
      EXPECT_EQ(verdictOn(head, {}), Verdict::kWrongMethod) << method << ' ' << path;
    }
  }
  RequestHead head = request("/");
  head.method = "HEAD";
  EXPECT_EQ(verdictOn(head, {}), Verdict::kPage);
}

TEST(Access, HostIsLocalhostAnAddressOrListed) {
  AccessRules rules;
  rules.hosts = {"robot.example"};
  for (const char* host :
       {"localhost", "localhost:1", "LOCALHOST:8080", "127.0.0.1:8080", "192.168.1.20",
        "[::1]:8080", "[fe80::1]", "robot.example:80", "Robot.Example"}) {
    EXPECT_EQ(verdictOn(request("/", host), rules), Verdict::kPage) << host;
  }
}

// DNS rebinding: the name of another site leads here, and its pages would count as ours.
TEST(Access, AnyOtherHostIsRefusedOnEveryPath) {
  for (const char* host : {"evil.example",
                           "evil.example:8080",
                           "localhost.evil.example",
                           "127.0.0.1.evil.example",
                           "evil.localhost",
                           "localhost.",
                           "",
                           ":8080",
                           "localhost:",
                           "localhost:80:80",
                           "localhost:808080",
                           "localhost:8o",
                           "localhost@evil.example",
                           "[::1",
                           "[::1]x",
                           "::1",
                           "[localhost]",
                           "[127.0.0.1]",
                           "127.1",
                           "0x7f.0.0.1",
                           "2130706433",
                           "local host",
                           "[]",
                           "localhost;",
                           "a\r\nb"}) {
    for (const char* path : {"/", "/report.js", "/nothing", "/socket"}) {
      EXPECT_EQ(verdictOn(request(path, host), {}), Verdict::kWrongHost) << host << ' ' << path;
    }
  }
}

TEST(Access, OneHostIsSaid) {
  RequestHead head = request("/");
  head.hosts.clear();
  EXPECT_EQ(verdictOn(head, {}), Verdict::kBadRequest);
  head.hosts = {"localhost", "localhost"};
  EXPECT_EQ(verdictOn(head, {}), Verdict::kBadRequest);
}

TEST(Access, APageOfAnotherOriginGetsNoSocketAndNoPage) {
  for (const char* origin :
       {"http://evil.example", "http://localhost", "http://localhost:3000", "http://127.0.0.1:8080",
        "null", "", "file://", "http://localhost:8080.evil.example", "http://localhost:8080/",
        "ws://localhost:8080", "http://evil@localhost:8080"}) {
    EXPECT_EQ(verdictOn(socket(origin), {}), Verdict::kWrongOrigin) << origin;
    RequestHead page = request("/");
    page.origins = {origin};
    EXPECT_EQ(verdictOn(page, {}), Verdict::kWrongOrigin) << origin;
  }
  RequestHead two = socket("http://localhost:8080");
  two.origins.emplace_back("http://localhost:8080");
  EXPECT_EQ(verdictOn(two, {}), Verdict::kBadRequest);
}

TEST(Access, OriginIsThisServerAsHostNamesIt) {
  EXPECT_EQ(verdictOn(socket("http://127.0.0.1:8080", "127.0.0.1:8080"), {}), Verdict::kSocket);
  EXPECT_EQ(verdictOn(socket("http://[::1]:8080", "[::1]:8080"), {}), Verdict::kSocket);
  EXPECT_EQ(verdictOn(socket("https://LOCALHOST:8080"), {}), Verdict::kSocket);
  RequestHead program = socket("");
  program.origins.clear();  // no browser
  EXPECT_EQ(verdictOn(program, {}), Verdict::kSocket);
}

TEST(Access, ASocketNeedsTheToken) {
  AccessRules rules;
  rules.token = kToken;
  const std::string token = kToken;
  const auto verdict = [&](const std::string& target) {
    RequestHead head = socket("http://localhost:8080");
    head.target = target;
    return verdictOn(head, rules);
  };
  EXPECT_EQ(verdict("/socket?token=" + token), Verdict::kSocket);
  for (const std::string& target :
       {std::string("/socket"), std::string("/socket?"), std::string("/socket?token="),
        "/socket?token=" + token + "x", "/socket?token=" + token.substr(1), "/socket?" + token,
        "/socket?Token=" + token, "/socket?token=" + token + "&a=b",
        "/socket?token=" + std::string(token.size(), 'x')}) {
    EXPECT_EQ(verdict(target), Verdict::kWrongToken) << target;
  }
}

TEST(Access, ASocketIsAskedForAsOne) {
  EXPECT_EQ(verdictOn(request("/socket"), {}), Verdict::kBadRequest);
}

TEST(Access, ATokenIsLongAndPlain) {
  EXPECT_TRUE(isGoodToken(kToken));
  EXPECT_TRUE(isGoodToken(std::string(16, 'a')));
  EXPECT_TRUE(isGoodToken(std::string(128, '0')));
  EXPECT_FALSE(isGoodToken(std::string(15, 'a')));
  EXPECT_FALSE(isGoodToken(std::string(129, 'a')));
  for (const char bad : {' ', '&', '=', '%', '\0', '/', '.', '\x80'}) {
    EXPECT_FALSE(isGoodToken(std::string(20, 'a') + bad)) << bad;
  }
}

}  // namespace
}  // namespace hovercraft_ros
