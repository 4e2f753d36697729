# surfmink-config-version.cmake - which versions find_package(surfmink 0.4) accepts. The version is that of the header.
# Before 1.0 the second number changes when programs have to, from 1.0 on the first.
file(STRINGS "${CMAKE_CURRENT_LIST_DIR}/../../../include/surfmink.h" PACKAGE_VERSION
     REGEX "^#define SURFMINK_VERSION +\"")
string(REGEX REPLACE ".*\"(.*)\"" "\\1" PACKAGE_VERSION "${PACKAGE_VERSION}")
string(REGEX MATCH "^(0\\.[0-9]+|[0-9]+)" surfmink_interface "${PACKAGE_VERSION}")
set(PACKAGE_VERSION_COMPATIBLE FALSE)
if(PACKAGE_FIND_VERSION_RANGE) # from a version up to another, as in find_package(surfmink 0.3...0.5)
  if(NOT PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION_MIN
     AND (PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION_MAX
          OR (PACKAGE_FIND_VERSION_RANGE_MAX STREQUAL "INCLUDE"
              AND PACKAGE_VERSION VERSION_EQUAL PACKAGE_FIND_VERSION_MAX)))
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
  endif()
elseif(NOT PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION
       AND "${PACKAGE_FIND_VERSION}." MATCHES "^${surfmink_interface}\\.")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
if(PACKAGE_VERSION VERSION_EQUAL PACKAGE_FIND_VERSION)
  set(PACKAGE_VERSION_EXACT TRUE)
endif()
