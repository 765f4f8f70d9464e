// SPDX-License-Identifier: GPL-3.0-or-later
#include "llvmpipe.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
// after osmesa.h, which brings gl.h
#include <GL/glext.h>

#include <cstddef>
#include <cstdlib>

namespace farop::bench {
namespace {

struct Corner {
  float x, y, z;
  std::uint8_t color[4];
};

}  // namespace

struct Llvmpipe::Context {
  OSMesaContext osmesa = nullptr;
  GLuint buffer = 0;
};

Llvmpipe::Llvmpipe(int threads) : context_(std::make_unique<Context>()), pixels_(4u * 1024 * 1024) {
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LP_NUM_THREADS", threads == 1 ? "0" : std::to_string(threads).c_str(), 1);
  const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_STENCIL_BITS, 0, 0, 0};
  context_->osmesa = OSMesaCreateContextAttribs(attributes, nullptr);
  if (context_->osmesa == nullptr ||
      OSMesaMakeCurrent(context_->osmesa, pixels_.data(), GL_UNSIGNED_BYTE, 1024, 1024) == GL_FALSE) {
    return;
  }
  name_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  name_ += std::string(", ") + reinterpret_cast<const char*>(glGetString(GL_VERSION));
  glViewport(0, 0, 1024, 1024);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(0, 1024, 0, 1024, 0, -1);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_DITHER);
  glDisable(GL_CULL_FACE);
  glShadeModel(GL_SMOOTH);
  glClearColor(0, 0, 0, 1);
  glClearDepth(1);
  glGenBuffers(1, &context_->buffer);
  glBindBuffer(GL_ARRAY_BUFFER, context_->buffer);
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
}

Llvmpipe::~Llvmpipe() {
  if (context_->osmesa != nullptr) OSMesaDestroyContext(context_->osmesa);
}

bool Llvmpipe::works() const {
  return name_.find("llvmpipe") != std::string::npos && glGetError() == GL_NO_ERROR;
}

void Llvmpipe::load(const TriangleScene& scene) {
  std::vector<Corner> corners;
  for (const ScreenPolygonBatch& batch : scene.batches) {
    for (const ScreenPolygonRecord& polygon : batch.polygons) {
      for (const ScreenVertex& v : batch.corners(polygon)) {
        const auto byte = [](std::uint16_t c) { return static_cast<std::uint8_t>(c); };
        // GL's samples lie in the middle of its pixels, ours on whole numbers.
        corners.push_back({static_cast<float>(v.x) / 256 + 0.5F,
                           static_cast<float>(v.y) / 256 + 0.5F,
                           static_cast<float>(v.z) / (1 << 24),
                           {byte(v.r), byte(v.g), byte(v.b), 255}});
      }
    }
  }
  corners_ = static_cast<int>(corners.size());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(Corner)), corners.data(),
               GL_STATIC_DRAW);
  glVertexPointer(3, GL_FLOAT, sizeof(Corner), nullptr);
  glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Corner), reinterpret_cast<const void*>(offsetof(Corner, color)));
}

void Llvmpipe::draw() {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawArrays(GL_TRIANGLES, 0, corners_);
  glFinish();
}

}  // namespace farop::bench
