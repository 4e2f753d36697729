# surfmink-config.cmake - for find_package(surfmink): the target surfmink::surfmink has the folder of the header and
# libm. make install puts it to PREFIX/share/cmake/surfmink; the installed folder may be moved as a whole.
if(TARGET surfmink::surfmink)
  return()
endif()
get_filename_component(surfmink_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
add_library(surfmink::surfmink INTERFACE IMPORTED)
set_target_properties(surfmink::surfmink PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${surfmink_prefix}/include")
if(NOT MSVC)
  set_target_properties(surfmink::surfmink PROPERTIES INTERFACE_LINK_LIBRARIES m)
endif()
unset(surfmink_prefix)
