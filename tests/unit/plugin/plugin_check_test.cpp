// SPDX-License-Identifier: GPL-3.0-or-later
// Every promise of the interface, kept and broken, on either side.
#include "plugin/plugin_check.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace farop {
namespace {

/// A rasterizer whose functions a test replaces.
struct Scripted {
  std::function<farop_status(const farop_frame*)> begin_frame = [](const farop_frame*) { return FAROP_OK; };
  std::function<farop_status(const farop_polygon*)> polygon = [](const farop_polygon*) { return FAROP_OK; };
  std::function<farop_status()> end_frame = [] { return FAROP_OK; };
  farop_status create_status = FAROP_OK;
  int created = 0, destroyed = 0;

  static Scripted& of(void* self) { return *static_cast<Scripted*>(self); }
  farop_rasterizer table(std::uint32_t wants) {
    current = this;
    farop_rasterizer t{};
    t.struct_size = sizeof t;
    t.wants = wants;
    t.create = [](const farop_host*, void** self) {
      ++current->created;
      *self = current;
      return current->create_status;
    };
    t.destroy = [](void* self) { ++of(self).destroyed; };
    t.begin_frame = [](void* self, const farop_frame* f) { return of(self).begin_frame(f); };
    t.polygon = [](void* self, const farop_polygon* p) { return of(self).polygon(p); };
    t.end_frame = [](void* self) { return of(self).end_frame(); };
    return t;
  }
  static inline Scripted* current = nullptr;
};

constexpr std::int32_t k_width = 10, k_height = 8;
constexpr std::int64_t k_row = 48;

class Contract : public testing::Test {
 protected:
  void make(std::uint32_t wants = 0) {
    inner_ = scripted_.table(wants);
    check_.emplace(inner_, [this](const ContractFinding& f) { findings_.push_back(f); });
    EXPECT_EQ(check_->create(nullptr), scripted_.create_status);
  }
  farop_status begin() { return check_->table().begin_frame(check_->self(), &frame_); }
  farop_status send() { return check_->table().polygon(check_->self(), &polygon_); }
  farop_status end() { return check_->table().end_frame(check_->self()); }
  /// One whole frame of one polygon.
  void draw() { begin(), send(), end(); }
  /// "verdict message" of the only finding, "" for none.
  std::string finding() const {
    if (findings_.empty()) return "";
    std::string text;
    for (const ContractFinding& f : findings_)
      text += (text.empty() ? "" : " | ") + f.verdict + " " + f.message;
    return text;
  }
  /// The host's promise `what` is found broken, once, by a frame that `make_wrong` has changed.
  void expect_broken(const std::string& what, const std::function<void()>& make_wrong,
                     std::uint32_t wants = 0) {
    make(wants);
    reset();
    make_wrong();
    draw();
    std::size_t found = 0;
    for (const ContractFinding& f : findings_) {
      EXPECT_TRUE(f.of_host) << f.message;
      EXPECT_EQ(f.verdict, "harness.error");
      if (f.message.find("farop broke its own promise: " + what) == 0) ++found;
    }
    EXPECT_EQ(found, 1u) << what << ": " << finding();
    findings_.clear();
  }
  void reset() {
    frame_ = {};
    frame_.struct_size = sizeof frame_;
    frame_.width = k_width, frame_.height = k_height;
    frame_.z_far = 65535;
    frame_.max_vertices = 4;
    frame_.row_bytes = k_row;
    frame_.pixels = memory_.data() + k_row;
    vertices_ = {{1, 1, 5, 1, 2, 3, 0}, {8, 1, 6, 1, 2, 3, 0}, {8, 6, 7, 1, 2, 3, 0}, {1, 6, 7, 1, 2, 3, 0}};
    polygon_ = {};
    polygon_.struct_size = sizeof polygon_;
    polygon_.vertex_count = 4;
    polygon_.vertices = vertices_.data();
    polygon_.flags = FAROP_POLYGON_CONVEX;
  }
  void SetUp() override { reset(); }

  Scripted scripted_;
  farop_rasterizer inner_{};
  std::optional<PluginCheck> check_;
  std::vector<ContractFinding> findings_;
  std::vector<std::uint8_t> memory_ = std::vector<std::uint8_t>((k_height + 2) * k_row, 7);
  farop_frame frame_{};
  farop_polygon polygon_{};
  std::vector<farop_vertex> vertices_;
  std::vector<farop_vec3> normals_ = std::vector<farop_vec3>(4, {0, 0, -1});
};

TEST_F(Contract, KeptByBothSidesIsNoFinding) {
  make();
  std::vector<std::uint32_t> seen;
  scripted_.polygon = [&](const farop_polygon* p) {
    seen.push_back(p->index);
    frame_.pixels[3 * p->vertices[0].x] = 9;
    return FAROP_OK;
  };
  for (std::uint32_t number = 0; number < 3; ++number) {
    frame_.number = number;
    frame_.width = k_width - static_cast<std::int32_t>(number);
    for (farop_vertex& v : vertices_) v.x = std::min(v.x, frame_.width - 1);
    begin();
    for (polygon_.index = 0; polygon_.index < 3; ++polygon_.index) send();
    end();
  }
  check_->table().destroy(check_->self());
  EXPECT_EQ(finding(), "");
  EXPECT_EQ(seen, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(scripted_.created, 1);
  EXPECT_EQ(scripted_.destroyed, 1);
}

TEST_F(Contract, PassesStatusesOn) {
  make();
  scripted_.polygon = [](const farop_polygon*) { return FAROP_E_MEMORY; };
  begin();
  EXPECT_EQ(send(), FAROP_E_MEMORY);
  frame_.number = 1;
  EXPECT_EQ(begin(), FAROP_OK) << "a new frame after one that is lost";
  EXPECT_EQ(finding(), "");
}

TEST_F(Contract, NamesStatusesThatAreNone) {
  make();
  scripted_.polygon = [](const farop_polygon*) { return 17; };
  scripted_.end_frame = [] { return -5; };
  draw();
  EXPECT_EQ(finding(),
            "abi.status polygon() returned no status of the interface: 17 (polygon 0) | "
            "abi.status end_frame() returned no status of the interface: -5");
}

TEST_F(Contract, NamesThePolygonThatWroteBehindARow) {
  make();
  scripted_.polygon = [&](const farop_polygon* p) {
    if (p->index >= 2) frame_.pixels[3 * k_row + 3 * k_width] ^= 1;
    return FAROP_OK;
  };
  begin();
  for (polygon_.index = 0; polygon_.index < 5; ++polygon_.index) send();
  end();
  EXPECT_EQ(finding(), "oob.write-stride it wrote behind the last pixel of a row: row 3 (polygon 2)");
  EXPECT_EQ(findings_[0].polygon, 2u);
  EXPECT_FALSE(findings_[0].of_host);
}

TEST_F(Contract, LooksAtTheEndOfTheFrameToo) {
  make();
  scripted_.end_frame = [&] {
    frame_.pixels[3 * k_width] ^= 1;
    return FAROP_OK;
  };
  draw();
  EXPECT_EQ(finding(), "oob.write-stride it wrote behind the last pixel of a row: row 0");
}

TEST_F(Contract, NamesWritingBeforeAndBehindTheFrame) {
  make();
  const std::span<const std::uint8_t> all(memory_);
  check_->watch({all.first(k_row), all.last(k_row)});
  scripted_.polygon = [&](const farop_polygon*) {
    frame_.pixels[-1] ^= 1, frame_.pixels[k_height * k_row] ^= 1;
    return FAROP_OK;
  };
  draw();
  EXPECT_EQ(finding(),
            "oob.write-before it wrote before the first row (polygon 0) | "
            "oob.write-after it wrote behind the last row (polygon 0)");
}

TEST_F(Contract, LastRowHasNoPaddingOfOurs) {
  make();
  scripted_.polygon = [&](const farop_polygon*) {
    frame_.pixels[(k_height - 1) * k_row + 3 * k_width] ^= 1;  // may be another's memory altogether
    return FAROP_OK;
  };
  draw();
  EXPECT_EQ(finding(), "");
}

TEST_F(Contract, NamesWritingIntoTheInput) {
  const std::function<void(farop_polygon*)> sins[] = {
      [](farop_polygon* p) { const_cast<farop_vertex*>(p->vertices)[1].z++; },
      [](farop_polygon* p) { const_cast<farop_vec3*>(p->normals)[3].x = 1; },
      [](farop_polygon* p) { p->flags = 0; }};
  for (const auto& sin : sins) {
    make(FAROP_WANT_NORMALS);
    polygon_.normals = normals_.data();
    scripted_.polygon = [&](const farop_polygon* p) {
      sin(const_cast<farop_polygon*>(p));
      return FAROP_OK;
    };
    draw();
    EXPECT_EQ(finding(), "oob.write-input it changed the polygon that it was given (polygon 0)");
    EXPECT_EQ(vertices_[1].z, 6) << "what the host has is out of reach";
    findings_.clear();
  }
  make();
  polygon_.normals = nullptr;
  scripted_ = {};
  inner_ = scripted_.table(0);
  scripted_.begin_frame = [](const farop_frame* f) {
    const_cast<farop_frame*>(f)->width = 1;
    return FAROP_OK;
  };
  draw();
  EXPECT_EQ(finding(), "oob.write-input it changed the farop_frame that it was given");
}

TEST_F(Contract, GivesRubbishToWhoKeepsPointers) {
  make();
  const farop_vertex* kept = nullptr;
  farop_vertex later{};
  scripted_.polygon = [&](const farop_polygon* p) {
    kept = p->vertices;
    return FAROP_OK;
  };
  scripted_.end_frame = [&] {
    later = *kept;
    return FAROP_OK;
  };
  draw();
  EXPECT_EQ(later.r, 0xA5);
}

TEST_F(Contract, NamesAChangedRoundingModeAndPutsItBack) {
  make();
  scripted_.polygon = [](const farop_polygon*) {
    std::fesetround(FE_UPWARD);
    return FAROP_OK;
  };
  draw();
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  EXPECT_EQ(
      finding(),
      "abi.float-state polygon() changed the rounding mode or how denormal numbers are treated (polygon 0)");
}

TEST_F(Contract, NamesCallsOutOfOrder) {
  make();
  send();
  end();
  begin(), begin();
  EXPECT_EQ(check_->create(nullptr), FAROP_OK);
  check_->table().destroy(check_->self());
  check_->table().destroy(check_->self());
  const std::string all = finding();
  for (const char* what :
       {"polygon() lies between begin_frame() and end_frame()",
        "end_frame() follows begin_frame() and its polygons",
        "begin_frame() follows create(), end_frame() or a failure",
        "create() is the first call, and called once", "destroy() is called once, after create()"}) {
    EXPECT_NE(all.find(what), std::string::npos) << what << "\n" << all;
  }
}

TEST_F(Contract, NamesWhatTheHostBreaks) {
  expect_broken("a frame has 1 .. 32767 pixels a side", [&] { frame_.height = 0; });
  expect_broken("0 .. 8 sub-pixel bits", [&] { frame_.subpixel_bits = 9; });
  expect_broken("0 <= z_near < z_far < 2^30", [&] { frame_.z_near = 65535; });
  expect_broken("row_bytes has room for the pixels", [&] { frame_.row_bytes = 29, frame_.height = 1; });
  expect_broken("pixels are there", [&] { frame_.pixels = nullptr; });
  expect_broken("frames are numbered", [&] { frame_.number = 1; });
  expect_broken("reserved members of the frame are 0", [&] { frame_.background[3] = 1; });
  expect_broken("farop_frame.struct_size", [&] { frame_.struct_size = 8; });
  expect_broken("farop_polygon.struct_size", [&] { polygon_.struct_size = 8; });
  expect_broken("a polygon has 3 corners or more", [&] { polygon_.vertex_count = 2; });
  expect_broken("no polygon has more than max_vertices", [&] { frame_.max_vertices = 3; });
  expect_broken(
      "nothing but triangles", [] {}, FAROP_WANT_TRIANGLES);
  expect_broken("flags are those of the interface", [&] { polygon_.flags |= 4; });
  expect_broken("polygons are numbered", [&] { polygon_.index = 1; });
  expect_broken("corners lie on the frame", [&] { vertices_[2].x = k_width; });
  expect_broken("corners lie on the frame", [&] { vertices_[2].y = -1; });
  expect_broken("depths lie between", [&] { vertices_[0].z = 65536; });
  expect_broken("reserved bytes of corners", [&] { vertices_[3].reserved = 1; });
  expect_broken("FAROP_POLYGON_CONVEX says", [&] { polygon_.flags = 0; });
  expect_broken("no normals unless asked for", [&] { polygon_.normals = normals_.data(); });
  expect_broken("no vertex ids unless asked for", [&] { polygon_.vertex_ids = &polygon_.index; });
  expect_broken(
      "normals have unit length",
      [&] {
        normals_[2] = {0, 0, 2};
        polygon_.normals = normals_.data();
      },
      FAROP_WANT_NORMALS);
  farop_material material{};
  material.struct_size = sizeof material;
  material.diffuse = 1.5f;
  expect_broken(
      "components of materials", [&] { polygon_.material = &material; }, FAROP_WANT_MATERIAL);
  expect_broken("no material unless asked for", [&] { polygon_.material = &material; });
}

TEST_F(Contract, SeesThatOnePolygonTurnsTheOtherWay) {
  make();
  begin();
  send();
  std::reverse(vertices_.begin(), vertices_.end());
  polygon_.flags |= FAROP_POLYGON_BACK_FACING;
  ++polygon_.index;
  send();
  EXPECT_EQ(finding(), "");
  // One thinner than a pixel may have been turned over by rounding.
  const std::vector<farop_vertex> whole = vertices_;
  polygon_.flags = 0;
  for (farop_vertex& v : vertices_) v.x = v.x > 4 ? 2 : 1;
  polygon_.flags = FAROP_POLYGON_CONVEX;
  ++polygon_.index;
  send();
  EXPECT_EQ(finding(), "");
  vertices_ = whole;
  polygon_.vertices = vertices_.data();
  ++polygon_.index;
  send();
  EXPECT_NE(finding().find("front faces turn one way"), std::string::npos);
}

}  // namespace
}  // namespace farop
