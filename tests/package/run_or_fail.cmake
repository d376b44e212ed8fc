# run(COMMAND ARGUMENT ...): runs a command and shows what it says; fails if it does.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${ARGN}\nfailed with ${result}\n${output}")
    endif()
    message("${output}")
endfunction()
