# What shortens a build from nothing.

# Small files spend most of their compile on headers, so a library's files are compiled together. The presets for development
# compile each by itself, which finds includes that are missing.
option(PROSPECT_UNITY "Compile the files of libraries together" ON)

# prospect_unity(NAME [TOGETHER] [ALONE FILE...]): compiles the files of each folder as one; TOGETHER: all of them as one. Files
# that name things of their own alike stay alone.
function(prospect_unity name)
  cmake_parse_arguments(U "TOGETHER" "" "ALONE" ${ARGN})
  if(NOT PROSPECT_UNITY)
    return()
  endif()
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # GCC takes what is private to a file for private to an included one.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(files ${name} SOURCES)
  list(REMOVE_ITEM files ${U_ALONE})
  foreach(file IN LISTS files)
    get_filename_component(folder ${file} DIRECTORY)
    if(U_TOGETHER)
      set(folder all)
    endif()
    string(MAKE_C_IDENTIFIER "in_${folder}" group)
    set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# prospect_precompiled(NAME [OWNER]): libtorch's headers, compiled once for all targets that share them with OWNER. ccache keeps
# such files only where the compiler tells it what was precompiled, and where it may trust that.
function(prospect_precompiled name)
  if(ARGC GREATER 1)
    target_precompile_headers(${name} REUSE_FROM ${ARGV1})
  else()
    target_precompile_headers(${name} PRIVATE <torch/torch.h>)
  endif()
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  if(CCACHE)
    set_target_properties(${name} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime;${CCACHE}")
  endif()
endfunction()
