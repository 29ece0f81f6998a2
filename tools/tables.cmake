if(NOT TARGET prospect_training)
  return()
endif()
add_library(prospect_tables STATIC
  ${CMAKE_CURRENT_SOURCE_DIR}/tables/bootstrap.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/tables/examples.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/tables/report.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/tables/row_cache.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/tables/scorer.cpp)
prospect_target(prospect_tables)
target_link_libraries(prospect_tables PUBLIC prospect_training prospect_tools_common)
