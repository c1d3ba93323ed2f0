# Configures and builds the examples' own project; fails where either does.
foreach(step "-S;${SOURCE};-B;${BINARY};-G;${GENERATOR};-Dcapstan_DIR=${CAPSTAN};-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
             "--build;${BINARY}")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
