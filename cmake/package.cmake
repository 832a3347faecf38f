# Debian packages of what install.cmake installs: `make package`. Their scripts are in config/debian.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME traygauge)
set(CPACK_PACKAGE_VENDOR "The Traygauge authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_CONTACT "The Traygauge authors <traygauge@users.noreply.github.com>")
# One version of the program has packages for each release of Debian; that for the newer release is the newer package.
set(CPACK_DEBIAN_PACKAGE_VERSION ${PROJECT_VERSION}~deb${debian_release})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL traygauge simulator)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_OUTPUT_FILE_PREFIX ${CMAKE_BINARY_DIR}/packages)

# Their first line is the short description.
set(CPACK_DEBIAN_TRAYGAUGE_PACKAGE_NAME traygauge)
set(CPACK_DEBIAN_TRAYGAUGE_DESCRIPTION "Food volumes from two pictures of a tray
Traygauge measures how much food is on a cafeteria tray. A camera sees the tray
from two directions; from these pictures and a reference card the program
rebuilds each dish in 3-D and reports the volume of every food item with its
standard deviation.

This package has the station (camera, button, lamp, arm), the hub, which keeps
the results and serves a page and an API, and the commands to set them up.")
set(CPACK_DEBIAN_TRAYGAUGE_PACKAGE_DEPENDS "systemd | systemd-standalone-sysusers")
set(CPACK_DEBIAN_TRAYGAUGE_PACKAGE_RECOMMENDS "libjs-three, udev")
set(CPACK_DEBIAN_TRAYGAUGE_PACKAGE_SUGGESTS "gnuplot-nox, traygauge-simulator")
file(WRITE ${generated_folder}/control/conffiles "/etc/traygauge/station.toml\n")
set(scripts ${PROJECT_SOURCE_DIR}/config/debian)
foreach(script preinst postinst prerm postrm)
  file(COPY_FILE ${scripts}/traygauge.${script} ${generated_folder}/control/${script} ONLY_IF_DIFFERENT)
  list(APPEND control_files ${generated_folder}/control/${script})
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${scripts}/traygauge.preinst ${scripts}/traygauge.postinst
  ${scripts}/traygauge.prerm ${scripts}/traygauge.postrm)
set(CPACK_DEBIAN_TRAYGAUGE_PACKAGE_CONTROL_EXTRA "${control_files};${generated_folder}/control/conffiles")

set(CPACK_DEBIAN_SIMULATOR_PACKAGE_NAME traygauge-simulator)
set(CPACK_DEBIAN_SIMULATOR_PACKAGE_SOURCE traygauge)
set(CPACK_DEBIAN_SIMULATOR_DESCRIPTION "Renderer and demo of Traygauge, without a camera
Traygauge measures how much food is on a cafeteria tray. This package renders
captures of trays whose volumes are known exactly, and plays two recorded trays
on a simulated station.")
set(CPACK_DEBIAN_SIMULATOR_PACKAGE_DEPENDS "traygauge (= ${CPACK_DEBIAN_PACKAGE_VERSION})")

# What the programs load. dpkg-shlibdeps knows only this machine's architecture; find_depends.py does for others.
if(CMAKE_CROSSCOMPILING)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS OFF)
  set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_BINARY_DIR}/depends.cmake)
else()
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
include(CPack)
