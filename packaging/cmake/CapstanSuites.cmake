# Read by CTest when it starts: a test for each suite of a GoogleTest executable. The including file sets
#   CAPSTAN_SUITES_NAME, CAPSTAN_SUITES_PROGRAM, CAPSTAN_SUITES_TIMEOUT, CAPSTAN_SUITES_LIST (the suites as last listed)
# A suite all of whose cases were skipped counts as skipped.
if(NOT EXISTS "${CAPSTAN_SUITES_PROGRAM}")
  add_test(${CAPSTAN_SUITES_NAME}_NOT_BUILT ${CAPSTAN_SUITES_NAME}_NOT_BUILT)
  return()
endif()
if(NOT EXISTS "${CAPSTAN_SUITES_LIST}" OR "${CAPSTAN_SUITES_PROGRAM}" IS_NEWER_THAN "${CAPSTAN_SUITES_LIST}")
  execute_process(
    COMMAND "${CAPSTAN_SUITES_PROGRAM}" --gtest_list_tests
    OUTPUT_VARIABLE listed
    RESULT_VARIABLE result
    TIMEOUT 60)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${CAPSTAN_SUITES_PROGRAM} --gtest_list_tests: ${result}")
  endif()
  file(WRITE "${CAPSTAN_SUITES_LIST}" "${listed}")
endif()
file(STRINGS "${CAPSTAN_SUITES_LIST}" listed REGEX "^[^ ]+\\.( |$)")  # cases are indented
foreach(line IN LISTS listed)
  string(REGEX REPLACE "\\.( .*)?$" "" suite "${line}")  # "Suite.  # TypeParam = …"
  add_test("${suite}" "${CAPSTAN_SUITES_PROGRAM}" "--gtest_filter=${suite}.*")
  set_tests_properties(
    "${suite}" PROPERTIES TIMEOUT ${CAPSTAN_SUITES_TIMEOUT}
                          SKIP_REGULAR_EXPRESSION "PASSED  \\] 0 tests\\.\n(\\[  SKIPPED \\][^\n]*\n)+$")
endforeach()
