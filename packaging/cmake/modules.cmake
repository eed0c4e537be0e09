# One target a module; its link list is the dependency rule of the architecture (docs/design.md).

get_filename_component(LIMPET_ROOT "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)

# What nearly every file includes, read once: half of a small file's compile time was Eigen and the
# standard library's headers. Each file still includes what it uses.
option(LIMPET_PRECOMPILE "precompiled headers" ON)
set(LIMPET_COMMON_HEADERS <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstring> <filesystem>
    <fstream> <functional> <limits> <map> <memory> <optional> <span> <sstream> <string> <string_view>
    <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)

# limpet_precompile(TARGET [tests]): the headers come precompiled, for tests with GoogleTest's. Modules,
# the shared library and tests have a holder each, with the compile options of those who use it; else the
# compiler refuses. Programs are compiled as modules are.
function(limpet_precompile target)
  if(NOT LIMPET_PRECOMPILE)
    return()
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL EXECUTABLE AND NOT ARGN)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE -fPIC)
    set(type STATIC_LIBRARY)
  endif()
  string(TOLOWER limpet_headers_${type}${ARGN} holder)
  if(NOT TARGET ${holder})
    if(type STREQUAL EXECUTABLE)
      add_executable(${holder} EXCLUDE_FROM_ALL ${LIMPET_ROOT}/packaging/cmake/headers.cpp)
    else()
      add_library(${holder} OBJECT ${LIMPET_ROOT}/packaging/cmake/headers.cpp)
    endif()
    target_link_libraries(${holder} PRIVATE Eigen3::Eigen fmt::fmt)
    set(headers ${LIMPET_COMMON_HEADERS})
    if(ARGN)
      target_link_libraries(${holder} PRIVATE GTest::gmock GTest::gtest)
      list(APPEND headers <gmock/gmock.h> <gtest/gtest.h>)
    endif()
    limpet_compile_options(${holder} ${ARGN})
    target_precompile_headers(${holder} PRIVATE ${headers})
  endif()
  # As the holder has it: a module that does not link fmt must agree too.
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
  target_precompile_headers(${target} REUSE_FROM ${holder})
endfunction()

# A few files are compiled as one: their headers are read and their templates made once, and a build from
# nothing takes much less. Names within the unnamed namespaces of a module, or of a test program, are
# therefore its own once. One by one (preset dev) is quickest for work on a single file.
set(LIMPET_UNITY 12 CACHE STRING "how many files are compiled as one; 1: each by itself")
function(limpet_unity target)
  if(LIMPET_UNITY GREATER 1)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${LIMPET_UNITY})
  endif()
endfunction()

# limpet_left_out(WHAT PACKAGE...): what is not built for want of packages. The build's left_out.txt has it, which ./test
# reads: a part that vanishes unseen takes its tests along.
function(limpet_left_out what)
  list(JOIN ARGN ", " packages)
  message(STATUS "left out: ${what}: needs ${packages}")
  list(JOIN ARGN " " packages)
  set_property(GLOBAL APPEND_STRING PROPERTY LIMPET_LEFT_OUT "${what}| ${packages}\n")
endfunction()

# limpet_install_if_built(FILE WHAT COMPONENT): an install of everything, as after ./run, leaves out what the rest of this
# CMakeLists.txt installs where it is not built, and says so. Who asks for a component by name, as packages do, gets it
# or an error.
function(limpet_install_if_built file what component)
  install(CODE "if(NOT CMAKE_INSTALL_COMPONENT AND NOT EXISTS \"${file}\")
  message(STATUS \"Left out, since it is not built: ${what} (ninja -C ${PROJECT_BINARY_DIR})\")
  return()
endif()" COMPONENT ${component})
endfunction()

# limpet_module(NAME SOURCES files... LINKS targets...)
# A module `suction` becomes the target limpet_suction; LINKS takes modules by their target names.
function(limpet_module name)
  cmake_parse_arguments(MODULE "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(limpet_${name} STATIC ${MODULE_SOURCES})
  add_library(limpet::${name} ALIAS limpet_${name})
  target_include_directories(limpet_${name} PUBLIC ${LIMPET_ROOT})
  target_link_libraries(limpet_${name} PUBLIC ${MODULE_LINKS} PRIVATE ${MODULE_PRIVATE_LINKS})
  limpet_compile_options(limpet_${name})
  limpet_precompile(limpet_${name})
  limpet_unity(limpet_${name})
endfunction()

# limpet_files(VARIABLE PATTERN...): files there and in folders below. One more or less changes its folder, which configures
# anew; with CONFIGURE_DEPENDS a dry run of ninja always had something to do, and ./run reported it each time.
function(limpet_files variable)
  file(GLOB_RECURSE found ${ARGN})
  foreach(file ${ARGN} ${found})
    get_filename_component(folder ${file} DIRECTORY)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder})
  endforeach()
  set(${variable} ${found} PARENT_SCOPE)
endfunction()

# limpet_text(VARIABLE FILE): what the file holds, for configure_file() to put into a source; changed, it
# configures anew.
function(limpet_text variable file)
  file(READ ${file} text)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# limpet_test(MODULE SOURCES files... LINKS targets... [LABEL label] [ALONE] [SECONDS limit]): one test program a module.
# ALONE: no other test runs meanwhile, for it runs in real time. SECONDS: after which a test has failed; 300 without it.
# The label `pictures` is for tests that draw: the sanitizers leave them out, they would watch Mesa.
function(limpet_test module)
  cmake_parse_arguments(TEST "ALONE" "LABEL;SECONDS" "SOURCES;LINKS" ${ARGN})
  if(NOT TEST_LABEL)
    set(TEST_LABEL unit)
  endif()
  if(NOT TEST_SECONDS)
    set(TEST_SECONDS 300)
  endif()
  add_executable(${module}_test ${TEST_SOURCES})
  target_link_libraries(${module}_test PRIVATE ${TEST_LINKS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${module}_test PRIVATE LIMPET_SOURCE_DIR="${LIMPET_ROOT}")
  limpet_compile_options(${module}_test tests)
  limpet_precompile(${module}_test tests)
  limpet_unity(${module}_test)
  gtest_discover_tests(${module}_test TEST_PREFIX ${module}. DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT ${TEST_SECONDS} LABELS ${TEST_LABEL} RUN_SERIAL ${TEST_ALONE})
endfunction()

# A compiler that nobody has tried may see more than GCC 10, 12, 13 and 14 do, and GCC sees ghosts in
# instrumented library code: there a warning stays a warning.
set(LIMPET_WERROR_DEFAULT OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^1[0234][.]"
    AND NOT LIMPET_SANITIZE)
  set(LIMPET_WERROR_DEFAULT ON)
endif()
option(LIMPET_WERROR "warnings are errors" ${LIMPET_WERROR_DEFAULT})

# A state is made and copied in vectors: x86's string instructions take longer to begin.
set(LIMPET_COPY_IN_VECTORS)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(LIMPET_COPY_IN_VECTORS -mmemset-strategy=vector_loop:1024:noalign,libcall:-1:noalign
                             -mmemcpy-strategy=vector_loop:1024:noalign,libcall:-1:noalign)
endif()

# Eigen multiplies and adds at once on arm64 by name, whatever -ffp-contract is, if this is defined (docs/arm64.md).
set(LIMPET_NO_FUSING)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  set(LIMPET_NO_FUSING -U__ARM_FEATURE_FMA)
endif()

# Warnings are errors on our code. No contraction to fused multiply-adds and no fast-math: the same
# scenario and seed must give the same bytes (docs/decisions/0006-determinism.md). errno of sqrt and
# the like is never read; not setting it changes no result and lets them be instructions.
# limpet_compile_options(TARGET [tests]): what is tested is optimised, the tests themselves compile a
# fifth faster with less.
function(limpet_compile_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    # GCC 12 sees overlaps and overruns in its own std::string (GCC bug 105651) once that comes precompiled.
    # Of a few files as one it takes each for a header.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage\;-Wno-restrict\;-Wno-array-bounds\;-Wno-stringop-overread\;-Wno-stringop-overflow\;-Wno-psabi>
    $<$<BOOL:${LIMPET_WERROR}>:-Werror> -ffp-contract=off -fno-math-errno
    # Our functions are nobody's to replace when the library is loaded: they may be inlined.
    -fno-semantic-interposition
    ${LIMPET_COPY_IN_VECTORS} ${LIMPET_NO_FUSING}
    # What is installed names files as the repository does, not where it was built.
    -fmacro-prefix-map=${LIMPET_ROOT}/=
    $<$<STREQUAL:${ARGN},tests>:-O1>)
  if(LIMPET_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${LIMPET_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${LIMPET_SANITIZE})
  endif()
endfunction()
