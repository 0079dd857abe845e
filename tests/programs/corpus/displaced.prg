MODULE Displaced
  CONST robtarget trapA:=[[1400,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    PDispOn \Rot, trapA, tool0;
    MoveL trapA, v100, fine, tool0;
    PDispOff;
  ENDPROC
ENDMODULE
