# Installed components, and the Debian packages made of them:
#   runtime      libtessera.so.N                      libtesseraN
#   display      libtessera-display.so.N              libtessera-displayN
#   development  headers, CMake package, pkg-config   libtessera-dev
#   imageio      module for image files               libtessera-imageioN
#   import       module for models                    libtessera-importN
#   program      bin/tessera                          tessera
#   documentation  share/doc/libtessera-doc           libtessera-doc
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tessera)
set(built_dir ${CMAKE_CURRENT_BINARY_DIR}/package)
set(tessera_package_runtime libtessera${tessera_soversion})
set(tessera_package_display libtessera-display${tessera_soversion})
set(tessera_package_development libtessera-dev)
set(tessera_package_imageio libtessera-imageio${tessera_soversion})
set(tessera_package_import libtessera-import${tessera_soversion})
set(tessera_package_program tessera)
set(tessera_package_documentation libtessera-doc)

install(TARGETS tessera EXPORT tessera-shared
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development)
install(TARGETS tessera_display EXPORT tessera-display
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT display NAMELINK_COMPONENT development)
install(TARGETS tessera_static EXPORT tessera-static
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
foreach(component runtime display development)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${tessera_package_${component}}
    RENAME copyright COMPONENT ${component})
endforeach()
install(DIRECTORY engine/tessera framebuffer/tessera
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)

# The static library and the display library have separate export files: only users of the static library need
# oneTBB's package, and the display library may be missing.
install(EXPORT tessera-shared NAMESPACE tessera:: DESTINATION ${package_dir} COMPONENT development)
install(EXPORT tessera-display NAMESPACE tessera:: DESTINATION ${package_dir} COMPONENT development)
install(EXPORT tessera-static NAMESPACE tessera:: DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/tessera-config.cmake.in ${built_dir}/tessera-config.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${built_dir}/tessera-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${built_dir}/tessera-config.cmake ${built_dir}/tessera-config-version.cmake
  DESTINATION ${package_dir} COMPONENT development)

# The pkg-config files are relocatable: their prefix is relative to their folder.
file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
foreach(name tessera tessera-display)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${built_dir}/${name}.pc @ONLY)
  install(FILES ${built_dir}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endforeach()

if(TARGET tessera_cli AND NOT CMAKE_CROSSCOMPILING)
  file(RELATIVE_PATH lib_from_bin /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(tessera_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${lib_from_bin}")
  set_target_properties(tessera_import PROPERTIES INSTALL_RPATH "$ORIGIN")
  install(TARGETS tessera_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  file(RELATIVE_PATH lib_from_libexec /${CMAKE_INSTALL_LIBEXECDIR}/tessera /${CMAKE_INSTALL_LIBDIR})
  foreach(program tessera_bench tessera_accuracy)
    if(TARGET ${program})
      set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/${lib_from_libexec}")
      install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/tessera COMPONENT program)
    endif()
  endforeach()
  # The program prints its manual page and its completions. The options of tessera bench, price and accuracy are
  # those that their programs describe.
  set(measurements)
  foreach(program tessera_bench tessera_accuracy)
    if(TARGET ${program})
      list(APPEND measurements ${program})
    endif()
  endforeach()
  foreach(page "man:tessera.1" "completion bash:completion.bash" "completion zsh:completion.zsh"
          "completion fish:completion.fish")
    string(REGEX REPLACE ":.*" "" arguments "${page}")
    string(REGEX REPLACE ".*:" "" file "${page}")
    add_custom_command(OUTPUT ${built_dir}/${file}
      COMMAND sh -c "'$<TARGET_FILE:tessera_cli>' ${arguments} > '${built_dir}/${file}'"
      DEPENDS tessera_cli ${measurements} VERBATIM)
    list(APPEND pages ${built_dir}/${file})
  endforeach()
  add_custom_target(tessera_pages ALL DEPENDS ${pages})
  install(FILES ${built_dir}/tessera.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES ${built_dir}/completion.bash
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME tessera COMPONENT program)
  install(FILES ${built_dir}/completion.zsh
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _tessera COMPONENT program)
  install(FILES ${built_dir}/completion.fish
    DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d RENAME tessera.fish COMPONENT program)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/tessera.thumbnailer
    DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers COMPONENT program)
  install(TARGETS tessera_import LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT import NAMELINK_SKIP)
  install(TARGETS tessera_imageio LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT imageio NAMELINK_SKIP)
  foreach(component imageio import program)
    install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${tessera_package_${component}}
      RENAME copyright COMPONENT ${component})
  endforeach()
endif()

# Documentation: HTML of the public headers if there is Doxygen, guides, scene reference, options, examples.
set(tessera_doc_dir ${CMAKE_INSTALL_DATADIR}/doc/${tessera_package_documentation})
install(FILES LICENSE DESTINATION ${tessera_doc_dir} RENAME copyright COMPONENT documentation)
install(FILES CHANGELOG.md DESTINATION ${tessera_doc_dir} COMPONENT documentation)
foreach(page engine/README.md engine/program/README.md engine/program/scenes/README.md)
  get_filename_component(folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION ${tessera_doc_dir}/${folder} COMPONENT documentation)
endforeach()
install(DIRECTORY tests/examples DESTINATION ${tessera_doc_dir} COMPONENT documentation
  FILES_MATCHING PATTERN "*.cpp" PATTERN "*.h" PATTERN "CMakeLists.txt")
find_program(TESSERA_DOXYGEN doxygen)
mark_as_advanced(TESSERA_DOXYGEN)
if(TESSERA_DOXYGEN)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/Doxyfile.in ${built_dir}/Doxyfile @ONLY)
  file(GLOB documented_headers CONFIGURE_DEPENDS engine/tessera/*.h* framebuffer/tessera/*.h*)
  # Doxygen fails on warnings. A failure leaves no stamp.
  add_custom_command(OUTPUT ${built_dir}/html.stamp
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${built_dir}/html
    COMMAND ${TESSERA_DOXYGEN} ${built_dir}/Doxyfile
    COMMAND ${CMAKE_COMMAND} -E touch ${built_dir}/html.stamp
    DEPENDS ${documented_headers} ${built_dir}/Doxyfile COMMENT "HTML of the public headers" VERBATIM)
  add_custom_target(tessera_html ALL DEPENDS ${built_dir}/html.stamp)
  install(DIRECTORY ${built_dir}/html DESTINATION ${tessera_doc_dir} COMPONENT documentation)
endif()
if(TARGET tessera_cli AND NOT CMAKE_CROSSCOMPILING)
  install(FILES ${built_dir}/tessera.1 DESTINATION ${tessera_doc_dir} RENAME options.1 COMPONENT documentation)
endif()

# Builds everything that is installed, without tests.
add_custom_target(installed DEPENDS tessera tessera_display tessera_static)
if(TARGET tessera_cli)
  add_dependencies(installed tessera_cli)
endif()
foreach(program tessera_bench tessera_accuracy)
  if(TARGET ${program})
    add_dependencies(installed ${program})
  endif()
endforeach()
foreach(target tessera_pages tessera_html)
  if(TARGET ${target})
    add_dependencies(installed ${target})
  endif()
endforeach()

include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
