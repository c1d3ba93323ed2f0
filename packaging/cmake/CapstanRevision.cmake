# Keeps a header with the commit that is being built. Run as a script at every build (cmake -D SOURCE=… -D HEADER=… -P);
# the header is touched only when the answer changes. Empty outside a git checkout.
execute_process(
  COMMAND git describe --always --dirty --abbrev=10
  WORKING_DIRECTORY ${SOURCE}
  OUTPUT_VARIABLE revision
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
  RESULT_VARIABLE failed)
if(failed)
  set(revision "")
endif()
set(text "#define CAPSTAN_REVISION \"${revision}\"\n")
set(former "")
if(EXISTS ${HEADER})
  file(READ ${HEADER} former)
endif()
if(NOT text STREQUAL former)
  file(WRITE ${HEADER} "${text}")
endif()
