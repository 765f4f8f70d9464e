# SPDX-License-Identifier: GPL-3.0-or-later
# Install rules: the program, its manual, and the stages as libraries for find_package(farop).
include(CMakePackageConfigHelpers)

set(stages core shading scene parse_nff parse_sipp spd geometry solids raster shadow plugin isolate export)
install(TARGETS farop_pictures EXPORT farop-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(stage IN LISTS stages)
  install(TARGETS farop_${stage} EXPORT farop-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/${stage} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/farop
          FILES_MATCHING PATTERN "*.h" PATTERN "*_internal.h" EXCLUDE PATTERN "tcl_*.h" EXCLUDE
          PATTERN "script*.h" EXCLUDE)
endforeach()
install(TARGETS farop_sipp_model farop_sipp EXPORT farop-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/sipp_api/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/farop-sipp)
file(RELATIVE_PATH sipp_up /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(${PROJECT_SOURCE_DIR}/cmake/sipp.pc.in ${PROJECT_BINARY_DIR}/sipp.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/sipp.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(TARGETS farop_rasterizer_abi EXPORT farop-targets)
install(DIRECTORY plugins/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT farop-targets NAMESPACE farop:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/farop)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/farop-config.cmake.in ${PROJECT_BINARY_DIR}/farop-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/farop)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/farop-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/farop-config.cmake ${PROJECT_BINARY_DIR}/farop-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FaropOpenImageIO.cmake ${PROJECT_SOURCE_DIR}/cmake/FaropTcl.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FaropPlugin.cmake
              ${PROJECT_SOURCE_DIR}/plugins/exports.map
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/farop)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Scripts with the files that they source.
install(DIRECTORY spd_scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/farop/scenes
        FILES_MATCHING PATTERN "*.nff" PATTERN "*.sipp" PATTERN "*.tcl")
