# The fuzz targets as ordinary tests: each takes its seeds, whole and damaged, by replay.cpp.
find_package(Boost 1.74 REQUIRED COMPONENTS program_options)
find_package(nlohmann_json 3.11 REQUIRED)

set(seeds ${CMAKE_CURRENT_BINARY_DIR}/fuzz_seeds)
add_test(NAME Fuzz.MakesSeeds COMMAND ${TRIVALENT_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/make_corpus.py
         $<TARGET_FILE:trivalent> ${seeds})
set_tests_properties(Fuzz.MakesSeeds PROPERTIES FIXTURES_SETUP fuzz_seeds)

# trivalent_add_replay(off fuzz_mesh.cpp trivalent::remesh)
function(trivalent_add_replay name source)
  set(folder ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  add_executable(replay_${name} ${folder}/replay.cpp ${folder}/${source})
  trivalent_warnings(replay_${name})
  target_link_libraries(replay_${name} PRIVATE ${ARGN})
  add_test(NAME Fuzz.ReplaysSeeds/${name} COMMAND replay_${name} ${seeds}/${name})
  set_tests_properties(Fuzz.ReplaysSeeds/${name} PROPERTIES FIXTURES_REQUIRED fuzz_seeds TIMEOUT 300)
endfunction()

foreach(kind off obj ply stl vtk vtp vtu xyz)
  trivalent_add_replay(${kind} fuzz_mesh.cpp trivalent::remesh)
  target_compile_definitions(replay_${kind} PRIVATE FUZZED_NAME="a.${kind}")
endforeach()
trivalent_add_replay(repair fuzz_repair.cpp trivalent::remesh)
trivalent_add_replay(atoms fuzz_atoms.cpp trivalent::formats)
trivalent_add_replay(options fuzz_options.cpp trivalent::shell Boost::program_options
                     nlohmann_json::nlohmann_json TBB::tbb)
set(apps ${PROJECT_SOURCE_DIR}/apps/trivalent)
target_include_directories(replay_options PRIVATE ${apps})
target_sources(replay_options PRIVATE
  ${apps}/interruption.cpp ${apps}/remesh_options.cpp ${apps}/session.cpp ${apps}/terminal.cpp)
