// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <utility>
#include <vector>

#include "conformance/case_kinds.h"

namespace farop::conformance {

void run_repeat(Run& run, const Case& c, Outcome& out, CaseResult& row) {
  std::vector<Drawing> given;
  for (const Drawing& d : c.drawings) given.push_back(run.maker.as_given(d));
  const auto life = [&](std::uint8_t memory, int times) {
    std::vector<Framebuffer> pictures;
    const std::unique_ptr<Subject> subject = run.maker.make(memory);
    for (int t = 0; t < times; ++t) {
      for (const Drawing& d : given)
        pictures.push_back(run.picture_of(c, *subject, d, out).value_or(Framebuffer{}));
    }
    return pictures;
  };
  const std::vector<Framebuffer> twice = life(0, 2), again = life(0, 1), filled = life(0xA5, 1),
                                 other = life(0x3C, 1);
  const std::vector<Framebuffer> once(twice.begin(),
                                      twice.begin() + static_cast<std::ptrdiff_t>(given.size()));
  const std::vector<Framebuffer> second(twice.begin() + static_cast<std::ptrdiff_t>(given.size()),
                                        twice.end());
  const auto compare = [&](const std::vector<Framebuffer>& pictures, const char* verdict, const char* message,
                           const char* hint) {
    for (std::size_t i = 0; i < given.size(); ++i) {
      row.judged += window_of(given[i].frame).samples();
      if (same_picture(once[i], pictures[i]) || once[i].rgb.empty() || pictures[i].rgb.empty()) continue;
      Problem p;
      for (int y = 0; y < once[i].height; ++y) {
        for (int x = 0; x < once[i].width; ++x) {
          if (pixel_at(once[i], x, y) != pixel_at(pictures[i], x, y))
            p.wrong.push_back({x, y, Wrong::color, -1, -2, pixel_at(pictures[i], x, y)});
        }
      }
      row.wrong += p.wrong.size();
      p.case_id = row.id, p.verdict = verdict, p.message = message, p.hint = hint, p.drawing = given[i],
      p.got = pictures[i], p.count = p.wrong.size();
      out.problems.push_back(std::move(p));
      return true;
    }
    return false;
  };
  const char* read = "you read memory that was never written, or use a clock, an address or a random number";
  if (!compare(second, "det.rerun", "the same frame drawn again in the same life differs", read))
    compare(again, "det.rerun", "the same frames in another process differ", read);
  const char* clear = "you read memory that was never written: clear it first";
  if (!compare(filled, "det.fill", "pictures depend on what fresh memory contains", clear))
    compare(other, "det.fill", "pictures depend on what fresh memory contains", clear);
}

}  // namespace farop::conformance
