# cpack makes archives of what is installed: .tar.gz and .zip, named after version, system and processor. Debian's packages
# are made by tools/packaging/debian_package.
set(CPACK_PACKAGE_VENDOR "the Frond authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENCE)
set(CPACK_PACKAGE_FILE_NAME frond-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_GENERATOR TGZ ZIP)
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME frond-${PROJECT_VERSION})
set(CPACK_SOURCE_IGNORE_FILES ^${PROJECT_SOURCE_DIR}/build/ ^${PROJECT_SOURCE_DIR}/out/ /[.]git/ [.]git$ ^${PROJECT_BINARY_DIR}/)
include(CPack)
