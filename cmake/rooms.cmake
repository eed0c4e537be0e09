# One target a room; its link list is the dependency rule of the house (docs/design.md).

get_filename_component(LIMPET_ROOT "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)

# limpet_room(NAME SOURCES files... LINKS targets...)
# A room `suction` becomes the target limpet_suction; LINKS takes rooms by their target names.
function(limpet_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(limpet_${name} STATIC ${ROOM_SOURCES})
  add_library(limpet::${name} ALIAS limpet_${name})
  target_include_directories(limpet_${name} PUBLIC ${LIMPET_ROOT})
  target_link_libraries(limpet_${name} PUBLIC ${ROOM_LINKS} PRIVATE ${ROOM_PRIVATE_LINKS})
  limpet_compile_options(limpet_${name})
endfunction()

# limpet_test(ROOM SOURCES files... LINKS targets... [LABEL label] [ALONE]): one test program a room.
# ALONE: nothing else runs beside it, for it lives in real time.
# The label `pictures` is for tests that draw: the sanitizers leave them out, they would watch Mesa.
function(limpet_test room)
  cmake_parse_arguments(TEST "ALONE" "LABEL" "SOURCES;LINKS" ${ARGN})
  if(NOT TEST_LABEL)
    set(TEST_LABEL unit)
  endif()
  add_executable(${room}_test ${TEST_SOURCES})
  target_link_libraries(${room}_test PRIVATE ${TEST_LINKS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${room}_test PRIVATE LIMPET_SOURCE_DIR="${LIMPET_ROOT}")
  limpet_compile_options(${room}_test)
  # What is tested is optimised; the tests themselves compile a fifth faster so.
  target_compile_options(${room}_test PRIVATE -O1)
  gtest_discover_tests(${room}_test TEST_PREFIX ${room}. DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 300 LABELS ${TEST_LABEL} RUN_SERIAL ${TEST_ALONE})
endfunction()

# A compiler that nobody has tried may see more than these do, and GCC sees ghosts in instrumented
# library code: there a warning stays a warning.
set(LIMPET_WERROR_DEFAULT OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13
    AND NOT LIMPET_SANITIZE)
  set(LIMPET_WERROR_DEFAULT ON)
endif()
option(LIMPET_WERROR "warnings are errors" ${LIMPET_WERROR_DEFAULT})

# Warnings are errors on our code. No contraction to fused multiply-adds and no fast-math: the same
# scenario and seed must give the same bytes (docs/decisions/0006-determinism.md). errno of sqrt and
# the like is never read; not setting it changes no result and lets them be instructions.
function(limpet_compile_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    $<$<BOOL:${LIMPET_WERROR}>:-Werror> -ffp-contract=off -fno-math-errno)
  if(LIMPET_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${LIMPET_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${LIMPET_SANITIZE})
  endif()
endfunction()
