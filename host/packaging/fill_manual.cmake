# SPDX-License-Identifier: Apache-2.0
# cmake -D PROGRAM= -D VERSION= -D TEMPLATE= -D MANUAL= -P: writes the manual's page, the commands as PROGRAM
# describes them. Its date is SOURCE_DATE_EPOCH where that is set.
execute_process(COMMAND ${PROGRAM} manual OUTPUT_VARIABLE COMMANDS OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
string(TIMESTAMP DATE "%B %d, %Y" UTC)
configure_file(${TEMPLATE} ${MANUAL} @ONLY)
