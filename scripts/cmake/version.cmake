# Where a result came from: version, commit and build go into every output.
find_package(Git QUIET)
set(SLAGFLOW_COMMIT unknown)
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12 --exclude=*
                  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE described
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(SLAGFLOW_COMMIT ${described})
  endif()
endif()
configure_file(${PROJECT_SOURCE_DIR}/scripts/cmake/version.hpp.in ${PROJECT_BINARY_DIR}/generated/version.hpp)
add_library(slagflow_version INTERFACE)
target_include_directories(slagflow_version INTERFACE ${PROJECT_BINARY_DIR}/generated)
