MODULE Traps
  ! Each target named trap... must stay as it is; good1 to good3 may be corrected.
  PERS tooldata tGun:=[TRUE,[[10,0,150],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  PERS tooldata tMoved:=[TRUE,[[0,0,150],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  PERS tooldata tFixed:=[FALSE,[[0,0,150],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[1300,100,0],[1,0,0,0]],[[0,0,20],[1,0,0,0]]];
  PERS wobjdata wBelt:=[FALSE,FALSE,"CNV1",[[1300,100,0],[1,0,0,0]],[[0,0,20],[1,0,0,0]]];
  CONST robtarget good1:=[[1400,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget good2:=[[1450.5,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget good3:=[[1.1,2,880],[0,0,1,0],[0,0,0,0],[9E9,9E+09,9E9,9E9,9E9,9E9]];
  VAR robtarget trapAssigned:=[[1401,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget trapComponent:=[[1402,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapTwoTools:=[[1403,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapTwoFrames:=[[1404,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapRead:=[[1405,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapComputed:=[[1400+6,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapUnused:=[[1407,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapOffset:=[[1408,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapSearched:=[[1409,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapToolMoved:=[[1410,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapToolFixed:=[[1411,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapBelt:=[[1412,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapUnknownTool:=[[1413,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapTwice:=[[1414,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapArray{2}:=[[[1415,1,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],[[1416,1,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]];
  CONST robtarget trapNoRotation:=[[1417,100,900],[0.2,0,1,0.4],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapToolChosen:=[[1418,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapExternal:=[[1419,100,900],[0,0,1,0],[0,0,0,0],[0,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapCorr:=[[1420,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapFrameChosen:=[[1421,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget trapNamed:=[[1422,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget trapJoints:=[[0,-30,30,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ trapJoints, v100, fine, tGun;
    MoveJ good1, v100, z10, tGun \WObj:=wobj0;
    MoveL \Conc, good2, v100 \V:=50, fine \Inpos:=inpos20, tGun;
    MoveL good3, v100, fine, tGun \WObj:=wTable;
    trapAssigned := CRobT(\Tool:=tGun);
    MoveL trapAssigned, v100, fine, tGun;
    trapComponent.trans.x := 17;
    MoveL trapComponent, v100, fine, tGun;
    MoveL trapTwoTools, v100, fine, tGun;
    MoveL trapTwoTools, v100, fine, tool0;
    MoveL trapTwoFrames, v100, fine, tGun;
    MoveL trapTwoFrames, v100, fine, tGun \WObj:=wTable;
    MoveL trapRead, v100, fine, tGun;
    TPWrite "x" \Num:=trapRead.trans.x;
    MoveL trapComputed, v100, fine, tGun;
    MoveL Offs(trapOffset,0,0,50), v100, fine, tGun;
    MoveL RelTool(trapOffset,0,0,50 \Rz:=10), v100, fine, tGun;
    SearchL di1, trapSearched, trapSearched, v100, tGun;
    tMoved.tframe.trans.z := 151;
    MoveL trapToolMoved, v100, fine, tMoved;
    MoveL trapToolFixed, v100, fine, tFixed;
    MoveL trapBelt, v100, fine, tGun \WObj:=wBelt;
    MoveL trapUnknownTool, v100, fine, tElsewhere;
    MoveL trapTwice, v100, fine, tGun;
    MoveL trapArray{1}, v100, fine, tGun;
    MoveL trapNoRotation, v100, fine, tGun;
    MoveL trapToolChosen, v100, fine, tools{2};
    MoveL pElsewhere, v100, fine, tGun;
    MoveL [[1400,100,910],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tGun;
    MoveC good1, good2, v100, fine, tGun;
    MoveL trapExternal, v100, fine, tGun;
    MoveL trapCorr, v100, fine, tGun \Corr;
    MoveL trapFrameChosen, v100, fine, tGun \WObj?wTable;
    SetDataVal "trapNamed", p;
    MoveL trapNamed, v100, fine, tGun;
  ENDPROC
  PROC second(robtarget trapParameter)
    CONST robtarget trapTwice:=[[1430,100,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    MoveL trapTwice, v100, fine, tGun;
    MoveL trapParameter, v100, fine, tGun;
  ENDPROC
ENDMODULE
