# Installs into the build tree; then an outside project finds the package there, builds and runs.
set(prefix ${PROJECT_BINARY_DIR}/package/prefix)
add_test(NAME Package.Installs
  COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
add_test(NAME Package.IsFoundByAnOutsideProject
  COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${CMAKE_CURRENT_LIST_DIR} ${PROJECT_BINARY_DIR}/package/build
    --build-generator ${CMAKE_GENERATOR}
    --build-options -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}
      -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}
      -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
    --test-command package_check)
set_tests_properties(Package.Installs PROPERTIES FIXTURES_SETUP package)
set_tests_properties(Package.IsFoundByAnOutsideProject PROPERTIES
  FIXTURES_REQUIRED package TIMEOUT 600)
