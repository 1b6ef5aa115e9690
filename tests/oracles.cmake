# Oracles of the tests and rivals of the benchmarks: the reference renderer, and Mesa if OSMesa is installed.
include_guard()

include(${CMAKE_CURRENT_LIST_DIR}/reference/reference.cmake)

find_path(TESSERA_OSMESA_INCLUDE GL/osmesa.h)
find_library(TESSERA_OSMESA_LIBRARY OSMesa)
mark_as_advanced(TESSERA_OSMESA_INCLUDE TESSERA_OSMESA_LIBRARY)
file(GLOB mesa_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/mesa/*.cpp)
if(NOT TESSERA_OSMESA_INCLUDE OR NOT TESSERA_OSMESA_LIBRARY)
  message(STATUS "OSMesa not found (Debian: libosmesa6-dev): no picture tests, no benchmarks")
elseif(mesa_sources)
  add_library(tessera_mesa STATIC ${mesa_sources})
  target_link_libraries(tessera_mesa PRIVATE tessera_options PUBLIC tessera_reference ${TESSERA_OSMESA_LIBRARY})
  target_include_directories(tessera_mesa SYSTEM PUBLIC ${TESSERA_OSMESA_INCLUDE})
endif()
