# Build helpers: every target of the project is made by one of these, so that flags stand here once.

function(trivalent_warnings target)
  # gcc's -Wmaybe-uninitialized sees Eigen vectors that OpenMesh value-initializes as uninitialized.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    # Its bounds checks of std::string literals, wrong in gcc 12, are no longer silent once precompiled.
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>"
    $<$<BOOL:${TRIVALENT_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# trivalent_add_library(remesh SOURCES src/a.cpp ...): library trivalent::remesh, installed and exported.
function(trivalent_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})
  set(target trivalent_${name})
  add_library(${target} ${ARG_SOURCES})
  add_library(trivalent::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE src)
  trivalent_warnings(${target})
  install(TARGETS ${target} EXPORT trivalentTargets)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

# Compiles once what nearly every file of a target includes: a third of the build time otherwise.
# trivalent_precompile(target EIGEN | MESH | JSON | PROGRAM | TEST): vectors; and meshes; and JSON; options too; or GoogleTest.
# A target with the compiler flags of an earlier one shares its headers: trivalent_precompile(target LIKE earlier).
function(trivalent_precompile target headers)
  if(headers STREQUAL "LIKE")
    target_precompile_headers(${target} REUSE_FROM ${ARGN})
    return()
  endif()
  set(list <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <ostream> <span>
           <sstream> <string> <variant> <vector>)
  if(NOT headers STREQUAL "EIGEN")
    # In this order: see mesh.h.
    list(APPEND list <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh> <Eigen/Core>
                     <OpenMesh/Core/Geometry/EigenVectorT.hh> <OpenMesh/Core/Utils/PropertyManager.hh>)
  endif()
  list(APPEND list <Eigen/Core>)
  if(headers STREQUAL "PROGRAM")
    list(APPEND list <boost/program_options.hpp> <nlohmann/json.hpp>)
  elseif(headers STREQUAL "JSON")
    list(APPEND list <nlohmann/json.hpp>)
  elseif(headers STREQUAL "TEST")
    list(APPEND list <gtest/gtest.h>)
  endif()
  target_precompile_headers(${target} PRIVATE ${list})
endfunction()

# trivalent_add_test(libremesh_tests SOURCES a_test.cpp ... LIBRARIES trivalent::remesh)
function(trivalent_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  trivalent_warnings(${name})
  # What they call is optimized in the libraries; the tests themselves compile faster so.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_compile_definitions(${name} PRIVATE
    TRIVALENT_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data"
    TRIVALENT_MESHES="${TRIVALENT_MESHES}")
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gtest_main)
  if(TARGET libremesh_tests AND NOT name STREQUAL "libremesh_tests")
    trivalent_precompile(${name} LIKE libremesh_tests)
  else()
    trivalent_precompile(${name} TEST)
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()

# Installs the libraries as the CMake package `trivalent`.
function(trivalent_install_package)
  include(CMakePackageConfigHelpers)
  set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/trivalent)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/scripts/cmake/trivalentConfig.cmake.in
    ${PROJECT_BINARY_DIR}/trivalentConfig.cmake INSTALL_DESTINATION ${destination})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/trivalentConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/trivalentConfig.cmake
                ${PROJECT_BINARY_DIR}/trivalentConfigVersion.cmake DESTINATION ${destination})
  install(EXPORT trivalentTargets NAMESPACE trivalent:: DESTINATION ${destination})
endfunction()
