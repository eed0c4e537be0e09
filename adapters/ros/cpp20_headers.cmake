# cmake -DFROM="DIR;..." -DTO=DIR -P cpp20_headers.cmake
# ROS 1 headers name std::allocator's rebind, which C++20 took away (newer message generators ask
# std::allocator_traits). Copies of those that do, put right, a folder a package; the types are the
# same, and so is what is linked.
foreach(folder ${FROM})
  get_filename_component(package ${folder} NAME)
  file(GLOB headers ${folder}/*.h)
  foreach(header ${headers})
    file(READ ${header} text)
    string(FIND "${text}" "ContainerAllocator::template rebind<" found)
    if(found LESS 0)
      continue()
    endif()
    string(REPLACE "typename ContainerAllocator::template rebind<"
      "typename std::allocator_traits<ContainerAllocator>::template rebind_traits<" text "${text}")
    string(REPLACE ">::other" ">::allocator_type" text "${text}")
    string(REGEX REPLACE "#include \"([^/\"]+)\"" "#include <${package}/\\1>" text "${text}")
    get_filename_component(name ${header} NAME)
    set(old "")
    if(EXISTS ${TO}/${package}/${name})
      file(READ ${TO}/${package}/${name} old)
    endif()
    if(NOT text STREQUAL old)
      file(WRITE ${TO}/${package}/${name} "${text}")
    endif()
  endforeach()
endforeach()
