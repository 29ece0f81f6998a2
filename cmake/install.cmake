# cmake --install: where everything lies under PREFIX, as cli/installation.cpp and find_package(Prospect) find it. A running
# Prospect writes none of it.
#   bin/prospect               lib/prospect/            the programs that it starts
#   share/prospect/            weights, held-out trials, scenes, message types
#   include/prospect/, lib/    what a robot is built with; lib/cmake/Prospect/ finds it
#   share/doc/prospect/        the docs, and the examples that they name
# What trains, and with it libtorch, is a component of its own.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME prospect)
if(NOT TARGET prospect)
  return()
endif()

# prospect_programs(LIST FOLDER): the targets that lie in bin/, of this folder of the sources and those below it.
function(prospect_programs list folder)
  set(found)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    get_target_property(place ${target} RUNTIME_OUTPUT_DIRECTORY)
    if(type STREQUAL "EXECUTABLE" AND place STREQUAL PROSPECT_BIN)
      list(APPEND found ${target})
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    prospect_programs(more ${below})
    list(APPEND found ${more})
  endforeach()
  set(${list} ${found} PARENT_SCOPE)
endfunction()

prospect_programs(programs ${CMAKE_SOURCE_DIR})
list(REMOVE_ITEM programs prospect prospect-train)
install(TARGETS prospect RUNTIME DESTINATION bin)
install(TARGETS ${programs} RUNTIME DESTINATION lib/prospect)
if(TARGET prospect-train)
  install(TARGETS prospect-train RUNTIME DESTINATION lib/prospect COMPONENT train)
endif()
set(data share/prospect)
install(DIRECTORY config tasks DESTINATION ${data} PATTERN "*.h" EXCLUDE PATTERN "*.cpp" EXCLUDE PATTERN CMakeLists.txt EXCLUDE)
install(DIRECTORY model/held_out DESTINATION ${data}/model)
install(DIRECTORY services/console/page DESTINATION ${data}/services/console)
# Classifiers read labels when networks are scored in training; nothing else asks for them.
install(DIRECTORY model/weights DESTINATION ${data}/model PATTERN *-classifiers.safetensors EXCLUDE)

# `prospect version` tells the commit, which an installed tree no longer knows.
install(CODE "execute_process(COMMAND git -C [==[${CMAKE_SOURCE_DIR}]==] describe --always --dirty
  OUTPUT_FILE [==[${CMAKE_BINARY_DIR}/commit]==] ERROR_QUIET)")
install(FILES ${CMAKE_BINARY_DIR}/commit DESTINATION ${data})

set(completion ${CMAKE_BINARY_DIR}/share/completion.bash)
add_custom_command(OUTPUT ${completion}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/share
  COMMAND prospect completion bash > ${completion}
  DEPENDS prospect COMMENT "Completion for bash" VERBATIM)
add_custom_target(prospect_completion ALL DEPENDS ${completion})
install(FILES ${completion} DESTINATION share/bash-completion/completions RENAME prospect)

set(doc share/doc/prospect)
install(FILES README.md CHANGELOG.md DESTINATION ${doc})
install(FILES LICENSE DESTINATION ${doc} RENAME copyright)
install(DIRECTORY docs DESTINATION ${doc})
install(DIRECTORY examples DESTINATION ${doc} PATTERN examples/CMakeLists.txt EXCLUDE)

if(NOT TARGET prospect_robot)
  return()
endif()
install(TARGETS schema_gen RUNTIME DESTINATION lib/prospect)  # tells `prospect messages`
install(DIRECTORY lcmtypes DESTINATION ${data} FILES_MATCHING PATTERN *.lcm PATTERN schema_gen EXCLUDE)
install(DIRECTORY ${CMAKE_BINARY_DIR}/share/python DESTINATION ${data} PATTERN __pycache__ EXCLUDE)
if(TARGET prospect_types_jar)
  install(FILES ${PROSPECT_JAR} DESTINATION ${data})
endif()

# Includes are written as in the sources, from one root.
set(headers include/prospect)
install(FILES lcmtypes/checked_codec.h lcmtypes/counts.h lcmtypes/messages.h lcmtypes/schema.h lcmtypes/validate.h
  ${CMAKE_BINARY_DIR}/generated/lcmtypes/all_types.h ${CMAKE_BINARY_DIR}/generated/lcmtypes/fields.h
  DESTINATION ${headers}/lcmtypes)
install(DIRECTORY ${CMAKE_BINARY_DIR}/generated/prospect DESTINATION ${headers})
install(FILES services/common/host_filter.h DESTINATION ${headers}/services/common)
install(FILES examples/keyed/keyed.h DESTINATION ${headers}/examples/keyed)

set(config lib/cmake/Prospect)
install(TARGETS prospect_lcmtypes prospect_codec prospect_robot EXPORT ProspectTargets ARCHIVE DESTINATION lib
  INCLUDES DESTINATION ${headers})
install(EXPORT ProspectTargets NAMESPACE Prospect:: DESTINATION ${config})
include(CMakePackageConfigHelpers)
configure_package_config_file(cmake/ProspectConfig.cmake.in ${CMAKE_BINARY_DIR}/ProspectConfig.cmake INSTALL_DESTINATION ${config})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/ProspectConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/ProspectConfig.cmake ${CMAKE_BINARY_DIR}/ProspectConfigVersion.cmake cmake/FindLCM.cmake
  DESTINATION ${config})
