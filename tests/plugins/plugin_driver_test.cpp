// SPDX-License-Identifier: GPL-3.0-or-later
// The test driver must see what it is there to see.
#include "plugins/plugin_driver.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <stdexcept>

#include "plugins/plugin_cases.h"

namespace farop::test {
namespace {

/// What is complained about when bad_manners draws one triangle; "" is nothing.
std::string complaint_about(const std::string& sin) {
  PluginDriver driver(FAROP_BAD_MANNERS, {{"sin", sin}});
  try {
    driver.draw({}, std::vector{plugin_polygon({vertex(1, 1), vertex(9, 1), vertex(5, 9)})});
  } catch (const std::runtime_error& error) {
    std::fesetround(FE_TONEAREST);
    return error.what();
  }
  return "";
}

TEST(PluginDriver, SeesEverySin) {
  EXPECT_EQ(complaint_about(""), "");
  EXPECT_EQ(complaint_about("padding"),
            "bad_manners: wrote outside the picture, 192 bytes from its start (64 x 64, row_bytes 197)");
  EXPECT_EQ(complaint_about("before"),
            "bad_manners: wrote outside the picture, -1 bytes from its start (64 x 64, row_bytes 197)");
  EXPECT_EQ(complaint_about("behind"),
            "bad_manners: wrote outside the picture, 12608 bytes from its start (64 x 64, row_bytes 197)");
  EXPECT_EQ(complaint_about("corner"), "bad_manners: polygon changed what it was given");
  EXPECT_EQ(complaint_about("frame"), "bad_manners: the frame record was changed");
  EXPECT_EQ(complaint_about("rounding"), "bad_manners: polygon changed the rounding mode");
  EXPECT_EQ(complaint_about("status"), "bad_manners: polygon returned -3: second line");
}

TEST(PluginDriver, KeepsTheLinesOfTheLastCall) {
  PluginDriver driver(FAROP_BAD_MANNERS, {{"sin", "status"}});
  const std::vector triangle = {plugin_polygon({vertex(1, 1), vertex(9, 1), vertex(5, 9)})};
  EXPECT_THROW(driver.draw({}, triangle), std::runtime_error);
  EXPECT_EQ(driver.logs, (std::vector<std::string>{"first line", "second line"}));
  EXPECT_EQ(driver.last_log, "second line");
  driver.draw({}, {});
  EXPECT_TRUE(driver.logs.empty());
  EXPECT_EQ(driver.last_log, "");
}

TEST(PluginDriver, ReturnsThePictureWithoutPadding) {
  PluginDriver driver(FAROP_BAD_MANNERS);
  PluginFrame frame;
  frame.width = 3, frame.height = 2, frame.padding = 7;
  frame.background = {1, 2, 3};
  const PluginPicture picture =
      driver.draw(frame, std::vector{plugin_polygon({vertex(0, 0), vertex(2, 0), vertex(1, 1)})});
  EXPECT_EQ(picture.rgb, (std::vector<std::uint8_t>{77, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3}));
}

TEST(PluginDriver, RefusesWhatIsNoRasterizer) {
  EXPECT_THROW(PluginDriver("/nowhere/at/all.so"), std::runtime_error);
  EXPECT_THROW(PluginDriver(FAROP_BAD_MANNERS, {{"sin", "create"}}), std::runtime_error);
}

}  // namespace
}  // namespace farop::test
