# A program for any Linux with this glibc or a newer one (docs/decisions/0052-portable-builds.md): what it is linked with is
# inside, but for glibc; what it loads is MuJoCo, EGL and MPI, where they are. Libraries that come as archives are
# meant to be in a program; for Python's module their names stay inside.
set(CMAKE_FIND_LIBRARY_SUFFIXES .a .so)
set(Boost_USE_STATIC_LIBS ON)
set(LIMPET_PORTABLE_MATH "" CACHE FILEPATH "object with what this glibc rounds otherwise than a newer one (packaging/portable_math.c)")
add_link_options(${LIMPET_PORTABLE_MATH} -static-libstdc++ -static-libgcc -Wl,--exclude-libs,ALL -Wl,--as-needed)
