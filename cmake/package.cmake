# Debian packages of what cmake --install makes: ninja -C BUILD package. prospect, and prospect-train with what needs libtorch. They
# need the packages that their programs' libraries come from, as dpkg-shlibdeps finds them, and what they start, which
# packages.txt lists. Whoever hands them out names himself: -DCPACK_PACKAGE_CONTACT="NAME <ADDRESS>".
function(prospect_packages list scope)
  file(STRINGS packages.txt lines REGEX "^[a-z0-9.+-]+ +${scope}$")
  list(FILTER lines EXCLUDE REGEX "-dev ")
  list(TRANSFORM lines REPLACE " .*" "")
  list(JOIN lines ", " names)
  set(${list} ${names} PARENT_SCOPE)
endfunction()
prospect_packages(CPACK_DEBIAN_PROSPECT_PACKAGE_DEPENDS run)
prospect_packages(CPACK_DEBIAN_TRAIN_PACKAGE_DEPENDS train)
string(PREPEND CPACK_DEBIAN_TRAIN_PACKAGE_DEPENDS "prospect (= ${PROJECT_VERSION}), ")
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL prospect)
if(PROSPECT_TRAINING)
  list(APPEND CPACK_COMPONENTS_ALL train)
endif()
set(CPACK_PACKAGE_NAME prospect)
set(CPACK_DEBIAN_PROSPECT_PACKAGE_NAME prospect)
set(CPACK_DEBIAN_TRAIN_PACKAGE_NAME prospect-train)
set(CPACK_DEBIAN_TRAIN_DESCRIPTION "trains and scores Prospect's networks, with libtorch")
if(NOT CPACK_PACKAGE_CONTACT)
  set(CPACK_PACKAGE_CONTACT "Prospect <prospect@localhost>")
endif()
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "visual robot task planning on LCM")
set(CPACK_PACKAGE_DESCRIPTION
"Looks at a scene through a camera, imagines what its actions would do, searches those imagined futures with many planner workers
at once, carries out the best plan, and shows why it chose it, or refuses to act. With simulated worlds, trained weights, and what
a robot in the simulator's place is built with: message types for C++ and Java, a checked codec, a CMake package.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROSPECT_PACKAGE_SUGGESTS "prospect-train, g++, cmake, liblcm-dev, libssl-dev")  # the others: to build a robot
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
