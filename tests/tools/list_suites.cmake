# Writes a test for each suite of a test program, to be run by run_suite: to start a sanitized
# program takes longer than most of its tests. A name is PROGRAM's without _test and the suite's, as
# two programs may have suites of one name. Suites named *Long, or below such a name, get the label
# long.
#   cmake -D PROGRAM=… -D RUN=… -D OUTPUT=… -P list_suites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
  OUTPUT_VARIABLE listed RESULT_VARIABLE status TIMEOUT 60)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests: ${status}")
endif()
# A suite's line is its name, a dot and perhaps a comment; those of its tests are indented.
string(REPLACE ";" " " listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")
get_filename_component(room ${PROGRAM} NAME)
string(REGEX REPLACE "_test$" "" room ${room})
set(tests "")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^([^ ].*)\\.( +#.*)?$")
    continue()
  endif()
  set(suite ${CMAKE_MATCH_1})
  set(properties "TIMEOUT 600 LABELS unit")
  if(suite MATCHES "Long$|Long/")
    set(properties "TIMEOUT 7200 LABELS long")
  endif()
  string(APPEND tests
    "add_test([[${room}/${suite}]] [[${RUN}]] [[${PROGRAM}]] [[${suite}]])\n"
    "set_tests_properties([[${room}/${suite}]] PROPERTIES SKIP_RETURN_CODE 77 ${properties})\n")
endforeach()
file(WRITE ${OUTPUT} "${tests}")
