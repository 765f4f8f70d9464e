# SPDX-License-Identifier: GPL-3.0-or-later
# farop_add_plugin(NAME SOURCES ...): a rasterizer as a shared library NAME.so that exports its entry and nothing else.
# For this project's plug-ins and, through find_package(farop), for everybody's.
set(FAROP_PLUGIN_EXPORTS "${CMAKE_CURRENT_LIST_DIR}/exports.map")
if(NOT EXISTS "${FAROP_PLUGIN_EXPORTS}")  # in the source tree
  set(FAROP_PLUGIN_EXPORTS "${CMAKE_CURRENT_LIST_DIR}/../plugins/exports.map")
endif()

function(farop_add_plugin name)
  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})
  add_library(${name} MODULE ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES PREFIX "" C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden
                                           VISIBILITY_INLINES_HIDDEN ON LINK_DEPENDS "${FAROP_PLUGIN_EXPORTS}")
  target_link_libraries(${name} PRIVATE farop::rasterizer_abi)
  target_link_options(${name} PRIVATE "LINKER:--version-script=${FAROP_PLUGIN_EXPORTS}")
endfunction()
