#include "simulator/devices/tray_player.hpp"

#include <gtest/gtest.h>

#include "tests/simulator/devices/synthetic_captures.hpp"

namespace traygauge {
namespace {

TEST(TrayPlayer, HasNoTrayBeforeTheFirstPressAndStartsOverAfterTheLast) {
  SyntheticCaptures captures(2);
  TrayPlayer player(captures);
  EXPECT_FALSE(player.has_tray());
  for (const std::size_t expected : {0U, 1U, 0U}) {
    player.handle_press();
    EXPECT_TRUE(player.has_tray());
    EXPECT_EQ(player.capture_index(), expected);
  }
}

TEST(TrayPlayer, WithoutAnglesTheSecondViewIsWhereTheArmWasSent) {
  SyntheticCaptures captures(1);
  TrayPlayer player(captures);
  player.handle_press();
  EXPECT_EQ(player.second_view_angle_deg(), std::nullopt);
  EXPECT_EQ(player.view_seen_at(0.0, 0.0), 0);
  EXPECT_EQ(player.view_seen_at(12.0, 0.0), 0);
  EXPECT_EQ(player.view_seen_at(0.0, 18.0), 0);
  EXPECT_EQ(player.view_seen_at(18.0, 18.0), 1);
  EXPECT_EQ(player.view_seen_at(10.0, 18.0), 1);
  EXPECT_EQ(player.view_seen_at(-18.0, -18.0), 1);
}

TEST(TrayPlayer, WithAnglesShowsTheNearerView) {
  SyntheticCaptures captures(std::vector{SyntheticCapture{8, 6, 10.0, -6.0}});
  TrayPlayer player(captures);
  player.handle_press();
  EXPECT_DOUBLE_EQ(player.second_view_angle_deg().value(), -16.0);  // counted from the first view
  EXPECT_EQ(player.view_seen_at(0.0, 18.0), 0);
  EXPECT_EQ(player.view_seen_at(-7.9, 18.0), 0);
  EXPECT_EQ(player.view_seen_at(-8.1, 18.0), 1);
  EXPECT_EQ(player.view_seen_at(16.0, 18.0), 0);
}

TEST(TrayPlayer, EveryOtherPressMovesTheHand) {
  SyntheticCaptures captures(2);
  TrayPlayer player(captures, CameraMover::hand);
  for (const auto& [capture, view] : {std::pair(0U, 0), {0U, 1}, {1U, 0}, {1U, 1}, {0U, 0}}) {
    player.handle_press();
    EXPECT_EQ(player.capture_index(), capture);
    EXPECT_EQ(player.view_seen_by_hand(), view);
  }
}

TEST(TrayPlayer, AHandStartsOverWhenTheLampHasEndedTheScan) {
  SyntheticCaptures captures(3);
  TrayPlayer player(captures, CameraMover::hand);
  player.handle_press();
  player.handle_signal(Signal::hold_still);
  player.handle_signal(Signal::try_again);
  player.handle_press();
  EXPECT_EQ(player.capture_index(), 1U);
  EXPECT_EQ(player.view_seen_by_hand(), 0);
  player.handle_signal(Signal::ready);
  player.handle_press();
  EXPECT_EQ(player.capture_index(), 1U);
  EXPECT_EQ(player.view_seen_by_hand(), 1);
}

TEST(TrayPlayer, FindsAFrameOfThisTrayByItsNumber) {
  SyntheticCaptures captures(1);
  TrayPlayer player(captures);
  player.handle_press();
  player.note_played({7, 0});
  player.note_played({9, 1});
  EXPECT_EQ(player.find_played(7).value().view, 0);
  EXPECT_EQ(player.find_played(9).value().view, 1);
  EXPECT_FALSE(player.find_played(8));
  player.note_played({11, 1});
  EXPECT_FALSE(player.find_played(7));
  player.handle_press();
  EXPECT_FALSE(player.find_played(9));
}

TEST(TrayPlayer, SaysWhatCannotBeRead) {
  SyntheticCaptures captures(std::vector{SyntheticCapture{.readable = false}, SyntheticCapture{}});
  TrayPlayer player(captures);
  player.handle_press();
  EXPECT_FALSE(player.has_tray());
  EXPECT_EQ(player.problem(), "tray 0/view_0.jpg: damaged");
  player.handle_press();
  EXPECT_TRUE(player.has_tray());
}

}  // namespace
}  // namespace traygauge
