# CPU reference build: the .cu files are C++ with OpenMP; sort, scan and reduce come from Thrust.
set_source_files_properties(${core_sources} PROPERTIES LANGUAGE CXX)
slagflow_needs(OpenMP COMPONENTS CXX)

# The toolkit's Thrust when there is one, else the distribution's.
find_path(THRUST_INCLUDE thrust/version.h
          PATHS /usr/local/cuda/include/cccl /usr/local/cuda/include NO_DEFAULT_PATH)
find_path(THRUST_INCLUDE thrust/version.h)
if(NOT THRUST_INCLUDE)
  message(FATAL_ERROR "Thrust is missing. scripts/install installs it on Debian 12")
endif()

add_library(slagflow_backend INTERFACE)
target_include_directories(slagflow_backend SYSTEM INTERFACE ${THRUST_INCLUDE})
target_compile_definitions(slagflow_backend INTERFACE
  THRUST_HOST_SYSTEM=THRUST_HOST_SYSTEM_CPP THRUST_DEVICE_SYSTEM=THRUST_DEVICE_SYSTEM_OMP)
target_compile_options(slagflow_backend INTERFACE
  -fno-math-errno -fno-trapping-math $<$<BOOL:${SLAGFLOW_ARCH}>:-march=${SLAGFLOW_ARCH}>)
target_link_libraries(slagflow_backend INTERFACE OpenMP::OpenMP_CXX)
