# Videos to data sets: only where OpenCV is.
if(NOT OpenCV_FOUND OR NOT TARGET prospect_dataset)
  return()
endif()
set(jigsaws ${CMAKE_CURRENT_SOURCE_DIR}/jigsaws)
add_library(prospect_jigsaws STATIC ${jigsaws}/converter.cpp ${jigsaws}/video_frames.cpp)
prospect_target(prospect_jigsaws)
target_include_directories(prospect_jigsaws SYSTEM PRIVATE ${OpenCV_INCLUDE_DIRS})
target_link_libraries(prospect_jigsaws PUBLIC prospect_dataset prospect_tools_common
  PRIVATE opencv_core opencv_imgproc opencv_videoio)
