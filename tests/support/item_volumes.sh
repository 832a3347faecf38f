#!/bin/sh
# Reads one document of `measure --json` or `station --json` and prints a line "label ml" for each item that has a volume. For where
# there is nothing but a shell; elsewhere use a JSON library.
tr -d ' \n' | sed 's/.*"items":\[\([^]]*\)\].*/\1/' | tr '}' '\n' |
  sed -n 's/.*"label":\([0-9]*\).*"volume_ml":\([0-9.eE+-][0-9.eE+-]*\).*/\1 \2/p'
