"""Reading a trend from a file or a paste: each step in a module of its own, each says what it understood.

decode       bytes -> text
workbook     a spreadsheet file -> the same text
delimiter    text -> cells
numerals     a cell -> a number, with the decimal sign of the file
header       names, units, first row of numbers
columns      every column as numbers
instants     columns of time -> seconds, minutes or hours
roles        which column is time, PV, OP, SP
historian    one row for each value of a tag -> the same columns
cleaning     order, repeated instants, rubbish at the start
reader       all of them, in order
"""
