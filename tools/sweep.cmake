# Which run of a sweep is trained: without libtorch, so that it is tested without.
if(NOT TARGET prospect_cli)
  return()
endif()
find_package(yaml-cpp REQUIRED)
add_library(prospect_sweep STATIC ${CMAKE_CURRENT_SOURCE_DIR}/train/sweep.cpp)
prospect_target(prospect_sweep)
target_link_libraries(prospect_sweep PUBLIC prospect_cli PRIVATE prospect_base yaml-cpp)
