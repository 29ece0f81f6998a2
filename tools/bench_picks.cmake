if(NOT TARGET prospect_sim)
  return()
endif()
find_package(nlohmann_json 3 REQUIRED)
find_package(CLI11 REQUIRED)
add_executable(prospect-picks-bench ${CMAKE_CURRENT_SOURCE_DIR}/bench/picks_command.cpp)
prospect_target(prospect-picks-bench)
target_link_libraries(prospect-picks-bench PRIVATE prospect_sim prospect_tools_common
                                                  nlohmann_json::nlohmann_json CLI11::CLI11)
