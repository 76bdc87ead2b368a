#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "hovercraft_sim/web/client_message.h"
#include "hovercraft_sim/web/json_reader.h"

namespace hovercraft_ros {
namespace {

template <class Message>
Message parsed(const std::string& text) {
  const auto message = parseClientMessage(text);
  EXPECT_TRUE(message.has_value()) << text;
  if (!message || !std::holds_alternative<Message>(*message)) {
    ADD_FAILURE() << "another message: " << text;
    return {};
  }
  return std::get<Message>(*message);
}

TEST(ClientMessage, EachIsRead) {
  const auto drive = parsed<DriveMessage>(
      R"({"op":"drive","craft":"red","levels":{"rear":3.5,"left":0,"right":-1.5e-3}})");
  EXPECT_EQ(drive.craft, "red");
  EXPECT_EQ(drive.levels,
            (std::map<std::string, double>{{"rear", 3.5}, {"left", 0.0}, {"right", -1.5e-3}}));
  EXPECT_TRUE(parsed<SeatMessage>(R"({"op":"seat","craft":"red","take":true})").take);
  EXPECT_FALSE(parsed<SeatMessage>(R"({"op":"seat","craft":"red","take":false})").take);
  EXPECT_TRUE(parsed<PauseMessage>(" {\"paused\" : true ,\n\t\"op\":\"pause\"} ").paused);
  EXPECT_EQ(parsed<StepMessage>(R"({"op":"step","steps":100000})").steps, 100000U);
  EXPECT_EQ(parsed<ResetMessage>(R"({"op":"reset"})").seed, std::nullopt);
  EXPECT_EQ(parsed<ResetMessage>(R"({"op":"reset","seed":-12})").seed, -12);
  EXPECT_EQ(parsed<ResetMessage>(R"({"op":"reset","seed":9007199254740992})").seed,
            9007199254740992);
  EXPECT_EQ(parsed<PaceMessage>(R"({"op":"pace","factor":0.25})").factor, 0.25);
  EXPECT_EQ(parsed<NameMessage>(R"({"op":"name","name":"A\u00e9\ud83d\ude00 \"b\""})").name,
            "A\xc3\xa9\xf0\x9f\x98\x80 \"b\"");
}

TEST(ClientMessage, WhatIsNotOneIsNothing) {
  for (const char* text : {"",
                           " ",
                           "{}",
                           "[]",
                           "null",
                           "1",
                           "\"op\"",
                           R"({"op":"fly"})",
                           R"({"op":1})",
                           R"({"op":"drive"})",
                           R"({"op":"drive","craft":"red"})",
                           R"({"op":"drive","craft":"red","levels":3})",
                           R"({"op":"drive","craft":1,"levels":{}})",
                           R"({"op":"drive","craft":"red","levels":{"rear":"3"}})",
                           R"({"op":"drive","craft":"red","levels":{"rear":true}})",
                           R"({"op":"drive","craft":"red","levels":{"rear":null}})",
                           R"({"op":"drive","craft":"red","levels":{"rear":1e999}})",
                           R"({"op":"drive","craft":"red","levels":{"rear":NaN}})",
                           R"({"op":"drive","craft":"red","levels":{"rear":Infinity}})",
                           R"({"op":"drive","craft":"red","levels":{"rear":1,"rear":2}})",
                           R"({"op":"drive","craft":"red","levels":{"rear":{"a":1}}})",
                           R"({"op":"drive","craft":"red","levels":{},"more":1})",
                           R"({"op":"seat","craft":"red","take":1})",
                           R"({"op":"pause","paused":"yes"})",
                           R"({"op":"step","steps":0})",
                           R"({"op":"step","steps":-1})",
                           R"({"op":"step","steps":1.5})",
                           R"({"op":"step","steps":100001})",
                           R"({"op":"step"})",
                           R"({"op":"reset","seed":0.5})",
                           R"({"op":"reset","seed":9.1e15})",
                           R"({"op":"reset","seed":1,"a":1})",
                           R"({"op":"pace","factor":-1})",
                           R"({"op":"pace","factor":1001})",
                           R"({"op":"pace"})",
                           R"({"op":"name","name":7})",
                           R"({"op":"pause","paused":true}x)",
                           R"({"op":"pause","paused":true)",
                           R"({"op":"pause","op":"pause","paused":true})"}) {
    EXPECT_FALSE(parseClientMessage(text)) << text;
  }
}

TEST(ClientMessage, ANameIsShortAndOneLineOfPlainText) {
  const auto name = [](const std::string& text) {
    return parseClientMessage("{\"op\":\"name\",\"name\":\"" + text + "\"}").has_value();
  };
  EXPECT_TRUE(name(""));
  EXPECT_TRUE(name("<b>&amp;"));  // a text: the page shows it as one
  EXPECT_TRUE(name(std::string(kMostNameBytes, 'a')));
  EXPECT_FALSE(name(std::string(kMostNameBytes + 1, 'a')));
  EXPECT_FALSE(name("a\\nb"));
  EXPECT_FALSE(name("a\\tb"));
  EXPECT_FALSE(name("a\\u0000b"));
  EXPECT_FALSE(name("a\\u001bb"));
  EXPECT_FALSE(name("\\u2028"));
  EXPECT_FALSE(name("\xff"));
}

TEST(ClientMessage, SizeAndKeysAreBounded) {
  const std::string space(kMostMessageBytes, ' ');
  EXPECT_FALSE(parseClientMessage(R"({"op":"reset"})" + space));
  std::string levels;
  for (std::size_t i = 0; i < kMostJsonKeys; ++i) {
    levels += (i == 0 ? "\"a" : ",\"a") + std::to_string(i) + "\":0";
  }
  const auto drive = [](const std::string& all) {
    return parseClientMessage(R"({"op":"drive","craft":"red","levels":{)" + all + "}}").has_value();
  };
  EXPECT_TRUE(drive(levels));
  EXPECT_FALSE(drive(levels + ",\"b\":0"));
}

TEST(JsonReader, NumbersAreThoseOfJson) {
  const auto number = [](const std::string& text) {
    return readJson("{\"a\":" + text + "}").has_value();
  };
  for (const char* good : {"0", "-0", "10", "0.5", "-1.25E+3", "1e-400", "1e0"}) {
    EXPECT_TRUE(number(good)) << good;
  }
  for (const char* bad :
       {"+1", "01", ".5", "5.", "1e", "1e+", "-", "0x10", "1_0", "--1", "1e999", "1 2"}) {
    EXPECT_FALSE(number(bad)) << bad;
  }
}

TEST(JsonReader, TextsAreThoseOfJson) {
  const auto text = [](const std::string& inner) { return readJson("{\"a\":\"" + inner + "\"}"); };
  EXPECT_EQ(std::get<std::string>(text(R"(\"\\\/\b\f\n\r\t)")->at("a")), "\"\\/\b\f\n\r\t");
  EXPECT_EQ(std::get<std::string>(text(R"(\u0041\u20AC\ud834\uDD1E)")->at("a")),
            "A\xe2\x82\xac\xf0\x9d\x84\x9e");
  for (const char* bad : {"\\x", "\\u12", "\\u12g4", "\\ud834", "\\ud834x", "\\ud834\\u0041",
                          "\\udd1e", "\n", "\x01", "\\"}) {
    EXPECT_FALSE(text(bad)) << bad;
  }
}

}  // namespace
}  // namespace hovercraft_ros
