# lcm-gen's decoder takes memory for as many elements as a message says before it looks whether they are
# there: refuse a count that the bytes left cannot hold, and a text without its final zero.
s/^( *)(this->[a-z_0-9]+\.resize\((this->[a-z_0-9]+)\);)/\1if(\3 < 0 || \3 > maxlen - pos) return -1;\n\1\2/
s/^( *)if\((__[a-z_0-9]+_len__) > maxlen - pos\) return -1;/\1if(\2 < 1 || \2 > maxlen - pos) return -1;/
