// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise.h"

#include <cstdlib>

#include "library_internal.h"

Sipp_bool noise_ready = FALSE;

namespace farop::sipp_api {

double next_random() {
  return ::drand48();
}

const std::shared_ptr<const NoiseTable>& noise_table() {
  if (noise_ready == FALSE || !state().noise) noise_init();
  return state().noise;
}

}  // namespace farop::sipp_api

using namespace farop::sipp_api;

void noise_init() {
  guarded([] { state().noise = std::make_shared<const farop::NoiseTable>(next_random); });
  noise_ready = TRUE;
}
double noise(Vector* position) {
  return noise_table()->noise(to_vector(*position));
}
Vector Dnoise(Vector* position) {
  return from_vector(noise_table()->gradient(to_vector(*position)));
}
double turbulence(Vector* position, int octaves) {
  return noise_table()->turbulence(to_vector(*position), octaves);
}
