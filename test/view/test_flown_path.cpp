#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/view/flown_path.h"

namespace hovercraft_ros {
namespace {

geometry_msgs::Point at(double x) {
  geometry_msgs::Point point;
  point.x = x;
  return point;
}

std::vector<double> xOf(const FlownPath& path) {
  std::vector<double> x;
  for (const geometry_msgs::Point& point : path.points()) x.push_back(point.x);
  return x;
}

/// A flight along x at 1 m/s that began at x = 0; s.
void fly(FlownPath& path, int begin, int end, std::uint32_t episode, int origin) {
  for (int s = begin; s < end; ++s) {
    path.extend(at(s - origin), ros::Time(static_cast<std::uint32_t>(s), 0));
    path.enter(episode, ros::Time(static_cast<std::uint32_t>(s), 0));
  }
}

TEST(FlownPath, TakesPointsThatAreApart) {
  FlownPath path;
  path.extend(at(0.0), ros::Time(1, 0));
  path.extend(at(0.019), ros::Time(2, 0));
  path.extend(at(0.021), ros::Time(3, 0));
  EXPECT_EQ(xOf(path), (std::vector<double>{0.0, 0.021}));
}

TEST(FlownPath, ForgetsTheOlderHalf) {
  FlownPath path;
  const int longest = FlownPath::kLongest;
  fly(path, 1, longest + 2, 0, 0);
  ASSERT_EQ(path.points().size(), FlownPath::kLongest / 2 + 1);
  EXPECT_EQ(path.points().front().x, longest / 2 + 1);
  EXPECT_EQ(path.points().back().x, longest + 1);
}

TEST(FlownPath, BeginsAnewWithAnEpisodeWhicheverTopicComesFirst) {
  FlownPath pose_first;
  fly(pose_first, 10, 15, 0, 10);
  fly(pose_first, 15, 17, 1, 15);
  EXPECT_EQ(xOf(pose_first), (std::vector<double>{0.0, 1.0}));

  FlownPath state_first;
  fly(state_first, 10, 15, 0, 10);
  state_first.enter(1, ros::Time(16, 0));
  state_first.extend(at(5.0), ros::Time(15, 0));  // of the old episode, was late
  EXPECT_TRUE(state_first.points().empty());
  state_first.extend(at(0.0), ros::Time(16, 0));
  state_first.extend(at(1.0), ros::Time(17, 0));
  EXPECT_EQ(xOf(state_first), (std::vector<double>{0.0, 1.0}));
}

TEST(FlownPath, GoesOnWhenItHearsOfTheFirstEpisodeLate) {
  FlownPath path;
  path.extend(at(0.0), ros::Time(1, 0));
  path.enter(7, ros::Time(2, 0));
  path.extend(at(1.0), ros::Time(2, 0));
  EXPECT_EQ(xOf(path), (std::vector<double>{0.0, 1.0}));
}

TEST(FlownPath, BeginsAnewWhereABagIsPlayedAgain) {
  FlownPath with_states;
  fly(with_states, 10, 15, 0, 10);
  fly(with_states, 15, 20, 1, 15);
  fly(with_states, 10, 13, 0, 10);
  EXPECT_EQ(xOf(with_states), (std::vector<double>{1.0, 2.0}));  // the first pose came too early
  fly(with_states, 13, 15, 0, 10);
  EXPECT_EQ(with_states.points().size(), 4U);

  FlownPath state_first;
  fly(state_first, 10, 15, 0, 10);
  state_first.enter(0, ros::Time(10, 0));
  EXPECT_TRUE(state_first.points().empty());
  state_first.extend(at(0.0), ros::Time(10, 0));
  EXPECT_EQ(xOf(state_first), (std::vector<double>{0.0}));

  FlownPath without_states;
  for (const unsigned s : {10U, 11U, 12U, 10U, 11U}) {
    without_states.extend(at(s - 10.0), ros::Time(s, 0));
  }
  EXPECT_EQ(xOf(without_states), (std::vector<double>{0.0, 1.0}));
}

}  // namespace
}  // namespace hovercraft_ros
