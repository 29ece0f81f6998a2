if(NOT TARGET prospect_planner)
  return()
endif()
find_package(nlohmann_json 3 REQUIRED)
add_executable(prospect-bench ${CMAKE_CURRENT_SOURCE_DIR}/bench/search_command.cpp
                              ${CMAKE_CURRENT_SOURCE_DIR}/bench/simulated_arms.cpp
                              ${CMAKE_CURRENT_SOURCE_DIR}/bench/simulated_bus.cpp)
prospect_target(prospect-bench)
target_link_libraries(prospect-bench PRIVATE prospect_base prospect_planner nlohmann_json::nlohmann_json Threads::Threads)
