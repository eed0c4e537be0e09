# Debian packages of what is installed, a component each: `packaging/build`, or cpack in a build folder.
#
#   limpet           the program, its manual, completion, documents, a unit for systemd
#   limpet-data      scenarios, vehicles, surfaces: what all the others read
#   liblimpetX.Y     the shared library
#   liblimpet-dev    headers and package files
#   python3-limpet   the Python module
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL program data library development)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_NAME limpet)
set(CPACK_PACKAGE_VENDOR "The Limpet authors")
# Nobody's address: who publishes packages names his own, cmake -D CPACK_PACKAGE_CONTACT=...
set(CPACK_PACKAGE_CONTACT "The Limpet authors <limpet@localhost>" CACHE STRING "maintainer of the Debian packages")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

set(same "(= ${limpet_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(library liblimpet${limpet_VERSION_MAJOR}.${limpet_VERSION_MINOR})

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME limpet)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "limpet-data ${same}, gnuplot-nox, fonts-dejavu-core")
# What is loaded, which nobody finds by looking at a binary: MuJoCo of the version that its header has.
file(STRINGS ${MUJOCO_INCLUDE_DIR}/mujoco/mujoco.h mujoco REGEX "define mjVERSION_HEADER")
string(REGEX REPLACE ".* ([0-9]+)([0-9])([0-9])$" "libmujoco\\1.\\2.\\3" mujoco "${mujoco}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "${mujoco}, libegl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, openmpi-bin, ${library}, python3-limpet")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "perching of multirotors on walls with a suction cup
 Simulates, reproduces and flies the perching of a multirotor on vertical
 walls with a suction cup: one flight or thousands, figures and pages of
 them, a companion computer next to a real PX4.")

set(CPACK_DEBIAN_DATA_PACKAGE_NAME limpet-data)
set(CPACK_DEBIAN_DATA_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DATA_DESCRIPTION "perching of multirotors: scenarios, vehicles, surfaces
 What program, library and Python module of Limpet fly by name: every
 number with its source.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${LIMPET_ROOT}/packaging/debian/triggers)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "limpet-data ${same}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "${mujoco}")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "perching of multirotors: shared library
 Limpet's simulation of perching with a suction cup, for programs of one's
 own: fly, step, save and branch a flight, add your own stations.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblimpet-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library} ${same}, libeigen3-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "perching of multirotors: headers
 Headers, CMake's and pkg-config's files of Limpet's shared library.")

if(TARGET limpet_python AND NOT LIMPET_PYTHONS)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-limpet)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  find_package(Python COMPONENTS Interpreter QUIET)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "limpet-data ${same}, python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, ${mujoco}")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "perching of multirotors: Python module
 Flights, campaigns and recordings of Limpet from Python, and environments
 to learn in with the interface of Gymnasium.")
endif()

# Copyright and change log of each, as Debian has them.
find_program(LIMPET_GZIP gzip)
find_package(Git QUIET)
set(date "Thu, 01 Jan 1970 00:00:00 +0000")
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${LIMPET_ROOT} log -1 --format=%aD OUTPUT_VARIABLE committed
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  set(date "${committed}")
endif()
set(changes ${PROJECT_BINARY_DIR}/packaging)
configure_file(packaging/debian/changelog.in ${changes}/changelog.Debian @ONLY)
execute_process(COMMAND ${LIMPET_GZIP} -9nf ${changes}/changelog.Debian)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(folder share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES packaging/debian/copyright ${changes}/changelog.Debian.gz DESTINATION ${folder} COMPONENT ${component}
    EXCLUDE_FROM_ALL)
endforeach()
install(FILES README.md DESTINATION share/doc/limpet COMPONENT program)
install(FILES packaging/limpet-companion@.service DESTINATION lib/systemd/system COMPONENT program)
install(DIRECTORY docs/ DESTINATION share/doc/limpet COMPONENT program PATTERN decisions EXCLUDE PATTERN extending EXCLUDE)
include(CPack)
