# CUDA build, nvcc 12 or 13. The shared runtime lets one binary run on a GPU and under a replacement runtime.
if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES AND NOT DEFINED ENV{CUDAARCHS})
  set(CMAKE_CUDA_ARCHITECTURES 75-real 80 90)
endif()
if(NOT DEFINED CMAKE_CUDA_COMPILER AND NOT DEFINED ENV{CUDACXX} AND EXISTS /usr/local/cuda/bin/nvcc)
  set(CMAKE_CUDA_COMPILER /usr/local/cuda/bin/nvcc)
endif()
set(CMAKE_CUDA_RUNTIME_LIBRARY Shared)
enable_language(CUDA)
# So that programs find the runtime without LD_LIBRARY_PATH, which still goes before.
find_package(CUDAToolkit REQUIRED)
set(CMAKE_BUILD_RPATH ${CUDAToolkit_LIBRARY_DIR})
set(CMAKE_INSTALL_RPATH ${CUDAToolkit_LIBRARY_DIR})

add_library(slagflow_backend INTERFACE)
target_compile_definitions(slagflow_backend INTERFACE SLAGFLOW_CUDA)
target_include_directories(slagflow_backend SYSTEM INTERFACE ${CMAKE_CUDA_TOOLKIT_INCLUDE_DIRECTORIES})
if(SLAGFLOW_WARNINGS_AS_ERRORS)
  set(strict "SHELL:-Werror all-warnings" -Xcompiler=-Werror)
endif()
if(NOT SLAGFLOW_COMPACT)
  set(readable -lineinfo --no-compress)
elseif(CMAKE_CUDA_COMPILER_VERSION VERSION_GREATER_EQUAL 12.8)
  set(readable -compress-mode=size)
endif()
target_compile_options(slagflow_backend INTERFACE
  $<$<COMPILE_LANGUAGE:CUDA>:--extended-lambda --expt-relaxed-constexpr
  ${readable} ${strict} "SHELL:-Xcompiler -Wall,-Wextra">)
set_property(TARGET slagflow_backend PROPERTY INTERFACE_POSITION_INDEPENDENT_CODE ON)
