# SPDX-License-Identifier: GPL-3.0-or-later
include_guard(GLOBAL)

# farop_add_strict_plugin(NAME SOURCES ...): farop_add_plugin() with this project's warnings and language standards.
function(farop_add_strict_plugin name)
  farop_add_plugin(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES C_STANDARD 11 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF
                                           CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  # No contraction: the same numbers, and so the same picture, on every machine.
  target_compile_options(${name} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                         -Wno-sign-conversion $<$<BOOL:${FAROP_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# farop_ship_plugin(NAME SOURCES ...): the same, where the program finds it, and installed. A rasterizer runs in a process
# that has no sanitizer (apps/farop-runner), so in a build with sanitizers the tests get one more, NAME_sanitized.
function(farop_ship_plugin name)
  farop_add_strict_plugin(${name} ${ARGN})
  if(FAROP_SANITIZE)
    farop_add_strict_plugin(${name}_sanitized ${ARGN})
    target_compile_options(${name}_sanitized PRIVATE -fsanitize=${FAROP_SANITIZE} -fno-sanitize-recover=all
                                                     -fno-omit-frame-pointer)
    target_link_options(${name}_sanitized PRIVATE -fsanitize=${FAROP_SANITIZE})
  endif()
  set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/farop/plugins)
  install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/farop/plugins)
  add_dependencies(farop_plugins ${name})
endfunction()
