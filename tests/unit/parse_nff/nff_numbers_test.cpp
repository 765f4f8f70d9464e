// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_nff/nff_numbers.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace farop::nff {
namespace {

TEST(NffNumbers, ReadsEveryWayOfWritingANumber) {
  const struct {
    std::string_view text;
    double value;
  } cases[] = {{"5", 5.0},
               {"05", 5.0},
               {".5", 0.5},
               {"5.", 5.0},
               {"-.5", -0.5},
               {"+5", 5.0},
               {"+.5e1", 5.0},
               {"-5.25", -5.25},
               {"1e3", 1000.0},
               {"1E3", 1000.0},
               {"1e+3", 1000.0},
               {"1.e-3", 0.001},
               {"1.11022e-016", 1.11022e-16},
               {"1e0000000000000000000000000000000003", 1000.0},
               {"0e99999999999999999999999999", 0.0},
               {"0.1", 0.1},
               {"123456789012345678901234567890", 123456789012345678901234567890.0},
               {"1.7976931348623157e308", std::numeric_limits<double>::max()},
               {"4.9e-324", std::numeric_limits<double>::denorm_min()}};
  for (const auto& c : cases) {
    double value = -7;
    EXPECT_EQ(parse_number(c.text, value), NumberSyntax::number) << c.text;
    EXPECT_EQ(value, c.value) << c.text;
  }
}

TEST(NffNumbers, KeepsTheSignOfZero) {
  for (const std::string_view text : {"-0", "-0.0", "-.0e5", "-1e-999"}) {
    double value = 1;
    ASSERT_EQ(parse_number(text, value), NumberSyntax::number) << text;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(-0.0)) << text;
  }
}

TEST(NffNumbers, TurnsUnderflowIntoZeroSilently) {
  for (const std::string& text :
       {std::string("1e-400"), std::string("2e-324"), "0." + std::string(400, '0') + "1",
        std::string("123456e-99999999999999999999999"), std::string("+1e-324")}) {
    double value = 7;
    ASSERT_EQ(parse_number(text, value), NumberSyntax::number) << text;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(value), 0u) << text;
  }
}

TEST(NffNumbers, RefusesOverflowOfEitherSign) {
  for (const std::string& text :
       {std::string("1e309"), std::string("-1e309"), std::string("1.8e308"), "1" + std::string(400, '0'),
        std::string("0.00001e400"), std::string("1e99999999999999999999999")}) {
    double value = 7;
    EXPECT_EQ(parse_number(text, value), NumberSyntax::too_large) << text;
    EXPECT_EQ(value, 7) << text;
  }
}

TEST(NffNumbers, TellsLongMantissasWithOpposingExponentsApart) {
  double value = 0;
  EXPECT_EQ(parse_number("1" + std::string(400, '0') + "e-400", value), NumberSyntax::number);
  EXPECT_EQ(value, 1);
  EXPECT_EQ(parse_number("0." + std::string(399, '0') + "1e400", value), NumberSyntax::number);
  EXPECT_EQ(value, 1);
}

TEST(NffNumbers, RefusesWhatIsNoNumber) {
  for (const std::string_view text :
       {"",      "+",     "-",   ".",     "+.",   "-.",    "e5",  ".e5",  "1e",  "1e+",  "1e-",      "1.2.3",
        "1,5",   "1_000", "--1", "+-1",   "-+1",  "nan",   "NaN", "-nan", "inf", "+inf", "infinity", "0x10",
        "0X1p3", "1p3",   "1f",  "1.5d0", "1e5.", "1e1e1", "5 ",  " 5",   "p",   "1e0x1"}) {
    double value = 7;
    EXPECT_EQ(parse_number(text, value), NumberSyntax::not_a_number) << text;
    EXPECT_EQ(value, 7) << text;
  }
}

TEST(NffNumbers, TakesPlainIntegersOnlyForCounts) {
  const struct {
    std::string_view text;
    std::int64_t value;
  } cases[] = {{"3", 3},
               {"+3", 3},
               {"-3", -3},
               {"0003", 3},
               {"-0", 0},
               {"9223372036854775807", std::numeric_limits<std::int64_t>::max()},
               {"99999999999999999999", std::numeric_limits<std::int64_t>::max()},
               {"-99999999999999999999", std::numeric_limits<std::int64_t>::min()}};
  for (const auto& c : cases) {
    std::int64_t value = 7;
    EXPECT_TRUE(parse_integer(c.text, value)) << c.text;
    EXPECT_EQ(value, c.value) << c.text;
  }
  for (const std::string_view text :
       {"", "+", "-", "3.", "3.0", "3e0", "0x3", "+-3", "--3", "three", "3,", " 3"}) {
    std::int64_t value = 7;
    EXPECT_FALSE(parse_integer(text, value)) << text;
  }
}

TEST(NffNumbers, RecognisesFailedAttemptsAtANumber) {
  for (const std::string_view text :
       {"1,5", "0x1F", "1e", "nan", "NaN", "-inf", "+Infinity", "--5", "1.2.3", "-.5e", "1.5f", ",5x"}) {
    EXPECT_EQ(resembles_number(text), text != ",5x") << text;
  }
  for (const std::string_view text :
       {"", "-", ".", "p4", "s1", "wood.tga", "4wood.tga", "face", "e5", "info", "nano"}) {
    EXPECT_FALSE(resembles_number(text)) << text;
  }
}

}  // namespace
}  // namespace farop::nff
