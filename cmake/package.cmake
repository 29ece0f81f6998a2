# A Debian package of what cmake --install makes: ninja -C BUILD package. It needs the packages that its programs' libraries come
# from, as dpkg-shlibdeps finds them, and what they start, which packages.txt lists.
file(STRINGS packages.txt lines REGEX "^[a-z0-9.+-]+ +run")
list(TRANSFORM lines REPLACE " .*" "")
list(JOIN lines ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME prospect)
set(CPACK_PACKAGE_CONTACT "Prospect's maintainers <prospect@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "visual robot task planning on LCM")
set(CPACK_PACKAGE_DESCRIPTION
"Looks at a scene through a camera, imagines what its actions would do, searches those imagined futures with many planner workers
at once, carries out the best plan, and shows why it chose it, or refuses to act. With simulated worlds, trained weights, and what
a robot in the simulator's place is built with: message types for C++ and Java, a checked codec, a CMake package.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, liblcm-dev, libssl-dev")  # to build a robot
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
