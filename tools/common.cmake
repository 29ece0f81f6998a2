add_library(prospect_tools_common STATIC
  ${CMAKE_CURRENT_SOURCE_DIR}/common/causes.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/common/fork_map.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/common/interval.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/common/parts.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/common/progress.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/common/run_items.cpp)
set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/common/parts.cpp PROPERTIES
  COMPILE_DEFINITIONS PROSPECT_VERSION="${PROJECT_VERSION}")
prospect_target(prospect_tools_common)
target_link_libraries(prospect_tools_common PUBLIC prospect_base)
if(TARGET prospect_training)
  add_library(prospect_torch_main STATIC ${CMAKE_CURRENT_SOURCE_DIR}/common/torch_main.cpp)
  prospect_target(prospect_torch_main)
  target_link_libraries(prospect_torch_main PUBLIC prospect_training)
endif()
