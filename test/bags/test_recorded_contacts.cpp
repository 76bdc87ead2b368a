#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/Contact.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "hovercraft_sim/bags/replay.h"
#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/contact_messages.h"
#include "../support/files.h"

namespace hovercraft_ros {
namespace {

using hovercraft::ContactEvent;
using hovercraft::Vector3;
using hovercraft::testing::contentOf;
using hovercraft::testing::TestFolder;

/// Boxes, a ball and a hull that fall on an incline for one second: loose bodies and contact forces
/// are part of what determines the state of the craft.
class RecordedContacts : public ::testing::Test {
 protected:
  void SetUp() override {
    request_.scenario = "config/tumble.yaml";
    request_.duration = "1";
    request_.output = folder_.file("run.bag");
    request_.contacts = folder_.file("contacts.csv");
    std::ostringstream messages;
    simulate(request_, messages);
    core_.observe(&told_);
    told_.on_contact = [this](const ContactEvent& event) { expected_.push_back(event); };
    while (core_.tick() < 1000) core_.step();
    ASSERT_GT(expected_.size(), 10U);
  }

  std::vector<hovercraft_sim::Contact> contactsIn(const std::string& path) const {
    std::vector<hovercraft_sim::Contact> contacts;
    const rosbag::Bag bag(path);
    rosbag::View view(bag, rosbag::TopicQuery("/hovercraft_sim/contacts"));
    for (const rosbag::MessageInstance& instance : view) {
      contacts.push_back(*instance.instantiate<hovercraft_sim::Contact>());
      // Received with the states of the tick at whose step's end it was known.
      EXPECT_EQ(instance.getTime().toNSec(), contacts.back().tick * 1000000);
    }
    return contacts;
  }

  void expectContactsOfCore(const std::vector<hovercraft_sim::Contact>& contacts) const {
    ASSERT_EQ(contacts.size(), expected_.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      EXPECT_EQ(testing::differenceOf(contacts[i], expected_[i], 0), "") << "contact " << i;
    }
  }

  TestFolder folder_;
  SimulateRequest request_;
  hovercraft::RunCallbacks told_;
  hovercraft::Simulation core_{loadScenarioFile("config/tumble.yaml")};
  std::vector<ContactEvent> expected_;
};

TEST_F(RecordedContacts, AreThoseOfTheCoreInTheBag) {
  expectContactsOfCore(contactsIn(request_.output));
}

TEST_F(RecordedContacts, AreThoseOfTheCoreInTheCsv) {
  std::istringstream lines(contentOf(request_.contacts));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "time,kind,a,b,x,y,z,nx,ny,nz,jx,jy,jz");
  const char* const kinds[] = {"bounce", "stick", "rest"};
  for (const ContactEvent& event : expected_) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream row(line);
    const auto next = [&row] {
      std::string cell;
      std::getline(row, cell, ',');
      return cell;
    };
    EXPECT_EQ(std::stod(next()), event.time);
    EXPECT_EQ(next(), kinds[static_cast<int>(event.kind)]);
    EXPECT_EQ(next(), event.a);
    EXPECT_EQ(next(), event.b);
    for (const Vector3& vector : {event.p_WC, event.nhat_AB_W, event.impulse_B_W}) {
      for (Eigen::Index i = 0; i < 3; ++i) EXPECT_EQ(std::stod(next()), vector[i]) << line;
    }
    EXPECT_TRUE(row.eof()) << line;
  }
  EXPECT_FALSE(std::getline(lines, line)) << line;
}

TEST_F(RecordedContacts, AreTheSameInAReplayWhichIsIdentical) {
  std::string verdict;
  EXPECT_EQ(replayBag({request_.output, folder_.file("again.bag"), {}}, verdict), 0) << verdict;
  EXPECT_EQ(verdict.rfind("identical: ", 0), 0U) << verdict;
  expectContactsOfCore(contactsIn(folder_.file("again.bag")));
}

}  // namespace
}  // namespace hovercraft_ros
