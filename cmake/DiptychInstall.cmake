# The shared library libdiptych.so, and what `cmake --install` and `cpack` make of the project.
#   COMPONENT library: libdiptych.so, libdiptych_images.so. devel: headers, CMake package, pkg-config. program: diptych,
#   libdiptych_mpi.so.
file(GLOB library_sources CONFIGURE_DEPENDS app/library/*.cpp)
add_library(diptych_library SHARED ${library_sources})
add_library(Diptych::diptych ALIAS diptych_library)
target_link_libraries(diptych_library PRIVATE diptych_options diptych_backends diptych_build_info diptych_measure
                      diptych_scene)
configure_file(include/diptych/version.h.in include/diptych/version.h @ONLY)
target_include_directories(
  diptych_library PRIVATE app PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                     $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}/include>
                                     $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(diptych_library PUBLIC cxx_std_20)
# Its own code waits for backends, as the program's does.
target_compile_options(diptych_library PRIVATE $<$<CONFIG:Release>:-O1>)
target_link_options(diptych_library PRIVATE -Wl,--no-undefined -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/libdiptych.map)
set_target_properties(diptych_library PROPERTIES LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/libdiptych.map)
set_target_properties(diptych_library PROPERTIES OUTPUT_NAME diptych EXPORT_NAME diptych VERSION ${PROJECT_VERSION}
                                                 SOVERSION ${PROJECT_VERSION_MAJOR})
add_dependencies(diptych_library diptych_images)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Diptych)
install(TARGETS diptych_library EXPORT DiptychTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT devel)
install(TARGETS diptych_images LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
if(TARGET diptych_mpi)
  install(TARGETS diptych_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program)
endif()
install(DIRECTORY include/diptych ${CMAKE_CURRENT_BINARY_DIR}/include/diptych
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT devel FILES_MATCHING PATTERN *.h)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(DiptychConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_package_config_file(cmake/DiptychConfig.cmake.in DiptychConfig.cmake INSTALL_DESTINATION ${package_folder})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/DiptychConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/DiptychConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT devel)
install(EXPORT DiptychTargets NAMESPACE Diptych:: DESTINATION ${package_folder} COMPONENT devel)
configure_file(cmake/diptych.pc.in diptych.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/diptych.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT devel)

# One Debian package of all, whose dependencies dpkg-shlibdeps reads off the libraries.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME diptych)
set(CPACK_PACKAGE_CONTACT "the Diptych authors <diptych@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Path tracer on Embree and Vulkan whose backends check each other")
set(CPACK_PACKAGE_DESCRIPTION "The program diptych, its library and the headers to build on it.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libvulkan1, mesa-vulkan-drivers, openmpi-bin")  # opened at run time
include(CPack)
