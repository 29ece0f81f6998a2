if(NOT TARGET prospect_dataset OR NOT TARGET prospect_sim OR NOT TARGET prospect_drawing)
  return()
endif()
add_library(prospect_dataset_tool STATIC
  ${CMAKE_CURRENT_SOURCE_DIR}/dataset/action_table.cpp ${CMAKE_CURRENT_SOURCE_DIR}/dataset/info.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/dataset/sheet.cpp)
prospect_target(prospect_dataset_tool)
target_link_libraries(prospect_dataset_tool PUBLIC prospect_dataset prospect_sim prospect_drawing prospect_tools_common)
