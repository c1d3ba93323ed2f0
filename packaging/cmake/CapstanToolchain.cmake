# Language level, warnings, sanitizers and ccache for every target of the project.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(CAPSTAN_CCACHE ccache)
if(CAPSTAN_CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${CAPSTAN_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_INODECACHE=1 ${CAPSTAN_CCACHE})
  # BASEDIR: clones and build folders share objects. INODECACHE: precompiled headers are hashed once, not at every use.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)  # for ccache, with precompiled headers
  endif()
endif()

# GNU ld takes 3 s of a processor for each of a hundred programs, gold (of the same package) less than 1 s. The maps of
# both are read by tests/architecture, that of LLD is not.
if(PROJECT_IS_TOP_LEVEL AND NOT CAPSTAN_SANITIZE)
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold CAPSTAN_HAS_GOLD)
  if(CAPSTAN_HAS_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

add_library(capstan_options INTERFACE)
target_compile_options(capstan_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                                 -Woverloaded-virtual -Werror)
target_include_directories(capstan_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)

option(CAPSTAN_ASSERTIONS "Invariants that run per sample (core/base/check.h)" ON)
if(NOT CAPSTAN_ASSERTIONS)
  target_compile_definitions(capstan_options INTERFACE CAPSTAN_NO_ASSERTIONS)
endif()

set(CAPSTAN_SANITIZE "" CACHE STRING "Sanitizers, comma separated: address,undefined or thread")
if(CAPSTAN_SANITIZE)
  target_compile_options(capstan_options INTERFACE -fsanitize=${CAPSTAN_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(capstan_options INTERFACE -fsanitize=${CAPSTAN_SANITIZE})
endif()

# The fuzz targets of tests/fuzz, with clang's libFuzzer (preset fuzz). Warnings are those of GCC's builds.
option(CAPSTAN_FUZZ "Fuzz targets; needs clang and its run-time library" OFF)
if(CAPSTAN_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "CAPSTAN_FUZZ needs clang: cmake --preset fuzz (Debian packages: clang libclang-rt-14-dev)")
  endif()
  target_compile_options(capstan_options INTERFACE -fsanitize=fuzzer-no-link -fno-sanitize-recover=all -w)
endif()

# A test costs more to compile than to run: what it calls is optimised in full, the test itself is not. -fPIC, which
# Qt asks of some tests, for all of them: they share precompiled headers.
set(CAPSTAN_TEST_OPTIONS $<$<CONFIG:Release>:-O1> -fPIC)
