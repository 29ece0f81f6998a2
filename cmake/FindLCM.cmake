# LCM::lcm. Debian's liblcm 1.3.1 has no CMake configuration, and its pkg-config file needs glib's, which liblcm-dev does not bring.
# It is installed beside ProspectConfig.cmake, which needs it, too.
find_path(LCM_INCLUDE_DIR lcm/lcm.h)
find_library(LCM_LIBRARY lcm)
mark_as_advanced(LCM_INCLUDE_DIR LCM_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LCM REQUIRED_VARS LCM_LIBRARY LCM_INCLUDE_DIR REASON_FAILURE_MESSAGE "Debian: liblcm-dev")
if(LCM_FOUND AND NOT TARGET LCM::lcm)
  add_library(LCM::lcm UNKNOWN IMPORTED)
  set_target_properties(LCM::lcm PROPERTIES IMPORTED_LOCATION ${LCM_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
endif()
