# What builds by itself beside the program, for programs of others: Gazebo's plugins, ROS's nodes. The
# language, and the rooms that they link, no others: no figures, and MuJoCo only where it is a target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

include(${CMAKE_CURRENT_LIST_DIR}/rooms.cmake)
set(LIMPET_DATA_DIR ${LIMPET_ROOT})
find_package(Eigen3 3.3 REQUIRED)
find_package(fmt REQUIRED)
foreach(room core wire mcap suction vehicle guidance models plant record sensors faults autopilot mavlink px4 devices scenario simulation)
  add_subdirectory(${LIMPET_ROOT}/limpet/${room} limpet/${room})
endforeach()
