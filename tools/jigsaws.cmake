# Videos to data sets.
if(NOT TARGET prospect_video OR NOT TARGET prospect_dataset)
  return()
endif()
set(jigsaws ${CMAKE_CURRENT_SOURCE_DIR}/jigsaws)
add_library(prospect_jigsaws STATIC ${jigsaws}/converter.cpp)
prospect_target(prospect_jigsaws)
target_link_libraries(prospect_jigsaws PUBLIC prospect_dataset prospect_tools_common PRIVATE prospect_video)
