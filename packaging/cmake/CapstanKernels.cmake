# Kernels: one source, compiled per instruction set (flags per file, never for a whole target) and chosen at run time.
include_guard(GLOBAL)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT CAPSTAN_FUZZ)
  set(CAPSTAN_X86_KERNELS TRUE CACHE INTERNAL "kernels for AVX2 and AVX-512 are compiled")
else()
  set(CAPSTAN_X86_KERNELS FALSE CACHE INTERNAL "kernels for AVX2 and AVX-512 are compiled")
endif()

# capstan_kernel(VARIABLE name): lists name_baseline.cpp, name_avx2.cpp and name_avx512.cpp in VARIABLE, flags set.
macro(capstan_kernel variable name)
  set(${variable} ${name}_baseline.cpp)
  if(CAPSTAN_X86_KERNELS)
    list(APPEND ${variable} ${name}_avx2.cpp ${name}_avx512.cpp)
  endif()
  set_source_files_properties(${${variable}} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)  # of other flags
  set(common -O3 -fno-math-errno -ffp-contract=fast)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND common -fno-tree-loop-distribute-patterns)
  endif()
  if(CAPSTAN_FUZZ)
    set(common -O0 -fno-sanitize=all -fno-sanitize-coverage=trace-pc-guard)  # minutes to compile, and no parsers
  endif()
  set(avx2 -mavx2 -mfma)
  set(avx512 -mavx512f -mavx512dq -mavx512vl)
  set_source_files_properties(${name}_baseline.cpp PROPERTIES COMPILE_OPTIONS "${common}")
  set_source_files_properties(${name}_avx2.cpp PROPERTIES COMPILE_OPTIONS "${common};${avx2}")
  set_source_files_properties(${name}_avx512.cpp PROPERTIES COMPILE_OPTIONS "${common};${avx2};${avx512}")
endmacro()
