# Helpers of scripts that run the command, whose path is FROND.

# Runs it: its text is in `result`, its exit code in `status`.
function(run result)
    execute_process(COMMAND ${FROND} ${ARGN} OUTPUT_VARIABLE text ERROR_VARIABLE errors RESULT_VARIABLE status)
    set(${result} "${text}${errors}" PARENT_SCOPE)
    set(status ${status} PARENT_SCOPE)
endfunction()
# Fails unless a text matches a pattern.
function(expect text pattern)
    if(NOT "${text}" MATCHES "${pattern}")
        message(FATAL_ERROR "expected \"${pattern}\" in:\n${text}")
    endif()
endfunction()
