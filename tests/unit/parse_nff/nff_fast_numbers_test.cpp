// SPDX-License-Identifier: GPL-3.0-or-later
// The short ways through numbers against the full conversion.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>

#include "nff_text.h"
#include "parse_nff/nff_numbers.h"
#include "parse_nff/nff_short_number.h"

namespace farop {
namespace {

/// Digits without sense but with every length and place of the point.
std::string random_decimal(std::mt19937_64& random) {
  std::string text;
  if (random() % 3 == 0) text += random() % 2 != 0 ? '-' : '+';
  for (auto n = random() % (random() % 4 == 0 ? 22 : 5); n > 0; --n)
    text += static_cast<char>('0' + random() % 10);
  if (random() % 5 != 0) text += '.';
  for (auto n = random() % (random() % 4 == 0 ? 22 : 9); n > 0; --n)
    text += static_cast<char>('0' + random() % 10);
  if (random() % 16 == 0) text += "e" + std::to_string(static_cast<int>(random() % 40) - 20);
  if (random() % 16 == 0) text += "xX_,/:;-+.eE\x7F\x80"[random() % 14];
  return text;
}

TEST(NffFastNumbers, TakesDecimalsAsTheFullConversionDoes) {
  std::mt19937_64 random(20261125);
  int taken = 0, left = 0;
  for (int i = 0; i < 400'000; ++i) {
    const std::string word = random_decimal(random);
    const std::string text = std::string(random() % 3, ' ') + word + std::string(60, i % 2 != 0 ? ' ' : '\n');
    WordReader reader(text, "numbers");
    double expected = 0;
    const nff::NumberSyntax syntax = nff::parse_number(word, expected);
    double value = 0;
    if (word.empty() || !reader.next_decimal(value)) {
      ++left;
      continue;
    }
    ++taken;
    ASSERT_EQ(syntax, nff::NumberSyntax::number) << word;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(expected)) << word;
  }
  EXPECT_GT(taken, 200'000);  // most are short
  EXPECT_GT(left, 50'000);
}

TEST(NffFastNumbers, ShortNumbersAreThoseOfTheFullConversion) {
  std::mt19937_64 random(20261126);
  int taken = 0;
  for (int i = 0; i < 400'000; ++i) {
    const std::string word = random_decimal(random);
    const std::string text =
        word + " -1.5 " + std::string(nff::k_short_number_bytes, i % 2 != 0 ? '7' : '\n');
    double value = 0, expected = 0;
    const char* const behind = nff::read_short_number(text.data(), value);
    if (behind == nullptr) continue;
    // It takes the start of a longer word, too: that is for the caller to see.
    const std::string_view number(text.data(), static_cast<std::size_t>(behind - text.data()));
    ++taken;
    ASSERT_EQ(nff::parse_number(number, expected), nff::NumberSyntax::number) << word;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(expected)) << word;
    ASSERT_TRUE(std::strchr("0123456789", *behind) == nullptr) << word;
  }
  EXPECT_GT(taken, 100'000);
}

TEST(NffFastNumbers, LeavesWhatItDoesNotTakeAsItWas) {
  for (const std::string word :
       {"1e5", "12345678901234567890", "0x1", "1..2", "p", "-", ".", "1-", "nan", "+-1"}) {
    const std::string text = "\r\n \n " + word + std::string(80, ' ');
    WordReader reader(text, "numbers");
    double value = 7;
    EXPECT_FALSE(reader.next_decimal(value)) << word;
    EXPECT_EQ(value, 7);
    Word next;
    ASSERT_TRUE(reader.next(next));
    EXPECT_EQ(next.text, word);
    EXPECT_EQ(next.line, 3u);
    EXPECT_EQ(next.column, 2u);
  }
}

TEST(NffFastNumbers, CountsLinesAndColumnsOverEveryLineEnd) {
  const std::string text = "1\r\n2\r3\n\n4 \t5\r\r\n 6" + std::string(80, ' ');
  WordReader fast(text, "numbers"), plain(text, "numbers");
  for (int i = 1; i <= 6; ++i) {
    double value = 0;
    ASSERT_TRUE(fast.next_decimal(value));
    EXPECT_EQ(value, i);
    Word word;
    ASSERT_TRUE(plain.next(word));
    EXPECT_EQ(fast.here().line, word.line);
    EXPECT_EQ(fast.here().column, word.column + 1);
  }
}

TEST(NffFastNumbers, TakesCountsInTheirRangeOnly) {
  const auto taken = [](const std::string& word) {
    const std::string text = word + std::string(80, ' ');
    WordReader reader(text, "numbers");
    std::int64_t count = -1;
    return reader.next_count(3, 500, count) ? count : -1;
  };
  EXPECT_EQ(taken("3"), 3);
  EXPECT_EQ(taken("0500"), 500);
  for (const char* word : {"2", "501", "3.", "+3", "-3", "3x", "0000000003", "p"})
    EXPECT_EQ(taken(word), -1) << word;
}

// Long inputs cross the blocks in which files are read; texts in memory do not.
TEST(NffFastNumbers, DamagedScenesGiveTheSameAsWithoutTheShortWay) {
  std::mt19937_64 random(77);
  std::string scene = "f 1 1 1 1 0 0 0 1\n";
  for (int i = 0; i < 40; ++i) {
    const bool patch = random() % 2 != 0;
    const auto corners = 3 + random() % 4;
    scene += fmt::format("{} {}\n", patch ? "pp" : "p", corners);
    for (auto c = corners; c > 0; --c) {
      for (int k = patch ? 6 : 3; k > 0; --k)
        scene += fmt::format("{}{:.6g}", k % 3 == 0 ? "" : " ",
                             std::ldexp(static_cast<double>(random() >> 11), -52) - 1);
      scene += '\n';
    }
  }
  const char* const rounds = std::getenv("FAROP_TEST_MUTATIONS");
  for (int round = rounds != nullptr ? std::atoi(rounds) : 1500; round > 0; --round) {
    std::string damaged = scene;
    for (auto edits = random() % 4; edits > 0; --edits) {
      const std::size_t at = random() % damaged.size();
      switch (random() % 3) {
        case 0:
          damaged[at] = "0123456789.-+eEpv#% \n\r\tx"[random() % 24];
          break;
        case 1:
          damaged.insert(at, 1, "0123456789.-+eEpv#% \n\r\tx"[random() % 24]);
          break;
        default:
          damaged.erase(at, 1 + random() % 10);
          break;
      }
    }
    expect_same_as_plain(damaged, {});
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace farop
