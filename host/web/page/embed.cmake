# SPDX-License-Identifier: Apache-2.0
# Puts the files of the directory BUNDLE into TEMPLATE's string literals, as OUTPUT.
foreach(name index.html page.js page.css)
  string(MAKE_C_IDENTIFIER ${name} key)
  file(READ ${BUNDLE}/${name} ${key})
  if("${${key}}" MATCHES "\\)PENDULINE_PAGE\"")
    message(FATAL_ERROR "${BUNDLE}/${name}: found the end of its own string literal, expected none")
  endif()
  # For the Content-Security-Policy of a page that has them inside.
  string(SHA256 ${key}_sha256 "${${key}}")
endforeach()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
