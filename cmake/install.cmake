# What is installed and where, in two components: `traygauge`, a station with its hub, and `simulator`, the renderer and the
# demo. Programs lie in one folder; units start them through the link `active`, which the package's scripts
# (config/debian) turn to them only after they have checked themselves. Files are installed where Debian's release wants them.
set(programs_folder ${CMAKE_INSTALL_LIBEXECDIR}/traygauge/programs)
set(shared_folder ${CMAKE_INSTALL_DATADIR}/traygauge)
set(generated_folder ${CMAKE_BINARY_DIR}/generated)

# A sysroot is of this machine's release. Where that is no Debian, what is installed lies as in 13.
set(debian_release 13)
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release os_release)
  if(os_release MATCHES ";ID=debian" AND os_release MATCHES "VERSION_ID=\"([0-9]+)\"")
    set(debian_release ${CMAKE_MATCH_1})
  endif()
endif()
# Until 12, units and rules of packages lie outside of /usr.
if(debian_release LESS 13 AND CMAKE_INSTALL_PREFIX STREQUAL /usr)
  set(system_folder /lib)
else()
  set(system_folder lib)
endif()
set(configuration_folder ${CMAKE_INSTALL_FULL_SYSCONFDIR}/traygauge)

# The station file of a package names a hub, as its units expect: those lines of config/station.toml count there.
file(READ config/station.toml station_file)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS config/station.toml CHANGELOG.md)
foreach(line "[station]" "name = " "socket = " "folder = " "[hub]" "store = " "listen = ")
  string(FIND "${station_file}" "\n# ${line}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "config/station.toml: expected a line that begins with '# ${line}', which packages make count")
  endif()
  string(REPLACE "\n# ${line}" "\n${line}" station_file "${station_file}")
endforeach()
file(CONFIGURE OUTPUT ${generated_folder}/station.toml CONTENT "${station_file}" @ONLY)


# traygauge_install_link(COMPONENT PROGRAM): what people type leads to the program.
function(traygauge_install_link component program)
  set(link ${generated_folder}/links/${program})
  file(MAKE_DIRECTORY ${generated_folder}/links)
  file(CREATE_LINK ../${programs_folder}/${program} ${link} SYMBOLIC)
  install(FILES ${link} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component})
endfunction()

# The station and its hub.
install(TARGETS traygauge traygauge-calibrate traygauge-card traygauge-collect traygauge-hub traygauge-station
  DESTINATION ${programs_folder} COMPONENT traygauge)
traygauge_install_link(traygauge traygauge)
install(DIRECTORY config/dishes config/fleet config/network config/plots DESTINATION ${shared_folder}/config COMPONENT traygauge)
install(DIRECTORY firmware/page DESTINATION ${shared_folder} COMPONENT traygauge
  PATTERN README.md EXCLUDE PATTERN pictures EXCLUDE)
install(DIRECTORY simulator/demo/mash_and_meatballs/ DESTINATION ${shared_folder}/self-check COMPONENT traygauge)
install(FILES config/collector.toml DESTINATION ${shared_folder}/config COMPONENT traygauge)
install(FILES ${generated_folder}/station.toml DESTINATION ${configuration_folder} COMPONENT traygauge)
install(FILES config/systemd/traygauge-hub.service config/systemd/traygauge-station.service
  DESTINATION ${system_folder}/systemd/system COMPONENT traygauge)
install(FILES config/60-traygauge-gpio.rules DESTINATION ${system_folder}/udev/rules.d COMPONENT traygauge)
install(FILES config/systemd/sysusers.conf DESTINATION lib/sysusers.d RENAME traygauge.conf COMPONENT traygauge)
install(FILES config/systemd/modules-load.conf DESTINATION lib/modules-load.d RENAME traygauge.conf COMPONENT traygauge)

# The renderer and the demo.
install(TARGETS traygauge-simulate DESTINATION ${programs_folder} COMPONENT simulator)
traygauge_install_link(simulator traygauge-simulate)
install(PROGRAMS simulator/traygauge-demo DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT simulator)
install(DIRECTORY config/scenes DESTINATION ${shared_folder}/config COMPONENT simulator)
install(DIRECTORY simulator/demo DESTINATION ${shared_folder} COMPONENT simulator)
install(PROGRAMS simulator/run_demo.sh DESTINATION ${shared_folder} COMPONENT simulator)

foreach(component traygauge simulator)
  string(REGEX REPLACE "^simulator$" "traygauge-simulator" package ${component})
  install(FILES config/debian/copyright ${CMAKE_BINARY_DIR}/manual/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()
