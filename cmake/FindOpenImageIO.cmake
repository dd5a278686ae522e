# OpenImageIO::OpenImageIO from headers and libraries alone. Debian's own CMake files for it insist on its command-line
# tools, and those on Qt.
find_path(OpenImageIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_library(OpenImageIO_LIBRARY OpenImageIO)
find_library(OpenImageIO_UTIL_LIBRARY OpenImageIO_Util)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO REQUIRED_VARS OpenImageIO_LIBRARY OpenImageIO_UTIL_LIBRARY
                                  OpenImageIO_INCLUDE_DIR)
if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
  add_library(OpenImageIO::OpenImageIO INTERFACE IMPORTED)
  target_include_directories(OpenImageIO::OpenImageIO INTERFACE ${OpenImageIO_INCLUDE_DIR})
  target_link_libraries(OpenImageIO::OpenImageIO INTERFACE ${OpenImageIO_LIBRARY} ${OpenImageIO_UTIL_LIBRARY})
endif()
