# MuJoCo's headers: the library is loaded at its first use (limpet/loaded). Debian's mujocoConfig.cmake names a
# folder of libqhull-dev, which libmujoco-dev does not depend on.
find_path(MUJOCO_INCLUDE_DIR mujoco/mujoco.h REQUIRED)
add_library(mujoco INTERFACE IMPORTED GLOBAL)
target_include_directories(mujoco INTERFACE ${MUJOCO_INCLUDE_DIR})
