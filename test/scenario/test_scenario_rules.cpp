#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/broken_craft_rules.h"
#include "../support/broken_rules.h"
#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::BrokenRule;

class BrokenScenario : public ::testing::TestWithParam<BrokenRule> {};

TEST_P(BrokenScenario, IsRefusedWithSourceKeyValueAndRule) {
  const BrokenRule& rule = GetParam();
  const std::string text = testing::with(testing::validScenario(), rule.old_part, rule.new_part);
  const std::string complaint = testing::complaintAbout(text);
  EXPECT_EQ(complaint, std::string("test.yaml: ") + rule.message);
  EXPECT_EQ(std::count(complaint.begin(), complaint.end(), '\n'), 0);
}

std::string nameOf(const ::testing::TestParamInfo<BrokenRule>& rule) {
  return rule.param.name;
}

INSTANTIATE_TEST_SUITE_P(Keys, BrokenScenario, ::testing::ValuesIn(testing::kBrokenKeys), nameOf);

INSTANTIATE_TEST_SUITE_P(Numbers, BrokenScenario, ::testing::ValuesIn(testing::kBrokenNumbers),
                         nameOf);

INSTANTIATE_TEST_SUITE_P(Times, BrokenScenario, ::testing::ValuesIn(testing::kBrokenTimes), nameOf);

INSTANTIATE_TEST_SUITE_P(Structures, BrokenScenario,
                         ::testing::ValuesIn(testing::kBrokenStructures), nameOf);

INSTANTIATE_TEST_SUITE_P(Inertias, BrokenScenario, ::testing::ValuesIn(testing::kBrokenInertias),
                         nameOf);

INSTANTIATE_TEST_SUITE_P(Parts, BrokenScenario, ::testing::ValuesIn(testing::kBrokenParts), nameOf);

}  // namespace
}  // namespace hovercraft
